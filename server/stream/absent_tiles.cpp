#include "stream/absent_tiles.h"

#include <algorithm>
#include <utility>

namespace voxsheet::stream {

void leaveOutAbsent(FramePlan& plan, std::vector<std::size_t>& drawnBy, FrameResult& frame) {
    std::vector<bool> absent(plan.tiles.size(), false);
    for (std::size_t i = 0; i < drawnBy.size(); ++i)
        absent[drawnBy[i]] = frame.tiles[i].absent;
    if (std::find(absent.begin(), absent.end(), true) == absent.end()) return;
    std::vector<std::size_t> indexAfter(plan.tiles.size());
    std::vector<PlannedTile> kept;
    for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
        indexAfter[i] = kept.size();
        if (!absent[i]) kept.push_back(std::move(plan.tiles[i]));
    }
    plan.tiles = std::move(kept);
    std::erase_if(drawnBy, [&](std::size_t tile) { return absent[tile]; });
    for (std::size_t& tile : drawnBy)
        tile = indexAfter[tile];
    std::erase_if(frame.tiles, [](const TilePixels& pixels) { return pixels.absent; });
}

} // namespace voxsheet::stream
