#include "frame/tile_order.h"

#include "base/errors.h"

#include <utility>

namespace voxsheet {

TileChoice chooseTile(const std::vector<bool>& issued,
                      const std::function<TileReadiness(std::size_t tile)>& readinessOf) {
    using Ranked = std::pair<TileReadiness, std::size_t>;
    std::optional<Ranked> first;
    std::vector<std::size_t> onDisk; // the first two
    int resident = 0;
    for (std::size_t tile = 0; tile < issued.size() && resident < 2; ++tile) {
        if (issued[tile]) continue;
        const Ranked ranked{readinessOf(tile), tile};
        if (!first || ranked < *first) first = ranked;
        if (ranked.first == TileReadiness::Resident) ++resident;
        if (ranked.first == TileReadiness::OnDisk && onDisk.size() < 2) onDisk.push_back(tile);
    }
    if (!first) throw InternalError("a frame", "none of its tiles is left to be drawn");
    TileChoice choice{first->second, std::nullopt};
    for (const std::size_t tile : onDisk)
        if (tile != choice.tile && resident < 2 && !choice.ahead) choice.ahead = tile;
    return choice;
}

} // namespace voxsheet
