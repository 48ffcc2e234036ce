// In which order a frame's tiles are drawn: pure.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace voxsheet {

/// What a tile waits for before it can be drawn, the least first.
enum class TileReadiness {
    Resident, ///< nothing
    AtHand,   ///< uploads from host memory
    OnDisk    ///< its samples are read
};

struct TileChoice {
    std::size_t tile = 0;
    /// The first other one whose samples are on the disk, when no other one waits for nothing.
    std::optional<std::size_t> ahead;
};

/// Of the tiles that are not issued yet (one at least), the readiest and of those the first. Those whose
/// volumes are resident come first: with a working set larger than the budget, least-recently-used eviction
/// in a fixed order would throw out every volume just before it is needed. Likewise, after them, those that
/// host memory holds. `readinessOf` is asked for as few tiles as will do.
[[nodiscard]] TileChoice chooseTile(const std::vector<bool>& issued,
                                    const std::function<TileReadiness(std::size_t tile)>& readinessOf);

} // namespace voxsheet
