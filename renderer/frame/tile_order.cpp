#include "frame/tile_order.h"

#include "base/errors.h"

#include <utility>

namespace voxsheet {

TileChoice chooseTile(const std::vector<bool>& issued,
                      const std::function<TileReadiness(std::size_t tile)>& readinessOf) {
    using Ranked = std::pair<TileReadiness, std::size_t>;
    std::optional<Ranked> first, second;
    for (std::size_t tile = 0; tile < issued.size(); ++tile) {
        if (issued[tile]) continue;
        const Ranked ranked{readinessOf(tile), tile};
        if (!first || ranked < *first)
            second = std::exchange(first, ranked);
        else if (!second || ranked < *second)
            second = ranked;
        if (second && second->first == TileReadiness::Resident) break;
    }
    if (!first) throw InternalError("a frame", "none of its tiles is left to be drawn");
    return {first->second, second ? std::optional(second->second) : std::nullopt};
}

} // namespace voxsheet
