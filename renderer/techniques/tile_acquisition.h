// Makes resident what a tile is drawn from, or finds what stands in for it meanwhile.
#pragma once

#include "techniques/render_paths.h"
#include "techniques/tile_volumes.h"

#include <vector>

namespace voxsheet {

/// True when the tile's light reads a gradient texture.
[[nodiscard]] bool wantsGradientTexture(const TileSpec& tile, const RenderPaths& paths);

/// As the tile asks; the clip object at its level 0.
[[nodiscard]] TileLevels askedLevels(const TileSpec& tile);

/// The finest levels, from those that the tile asks for on, of which all that the tile needs fits the texture
/// budget together: what takes most is made coarser first, but for categories, which have no coarser levels.
/// Throws LimitExceeded if not even the coarsest ones fit, NotFound as ResidencyManager::acquire.
[[nodiscard]] TileLevels levelsWithinBudget(const ResidencyManager& residency, const TileSpec& tile,
                                            const RenderPaths& paths);

[[nodiscard]] bool isTileResident(const ResidencyManager& residency, const TileSpec& tile,
                                  const RenderPaths& paths, const TileLevels& levels);

/// What has to be read before it is.
[[nodiscard]] std::vector<WantedVolume> missingVolumes(const ResidencyManager& residency,
                                                       const TileSpec& tile, const RenderPaths& paths,
                                                       const TileLevels& levels);

/// Empty as long as it must be called again. Throws as ResidencyManager::acquire.
[[nodiscard]] std::optional<TileVolumes> acquireTileBy(ResidencyManager& residency, const TileSpec& tile,
                                                       const RenderPaths& paths, const TileLevels& levels,
                                                       Deadline deadline,
                                                       const DerivedTextureBuilder& buildGradients);

/// What comes nearest to these levels and is resident; of a volume of which nothing is, a small level is
/// brought in before the deadline, and of categories their own one. Empty when that came first. What is
/// missing is queued. Throws as ResidencyManager::acquire.
[[nodiscard]] std::optional<TileVolumes> acquireTileAtHand(ResidencyManager& residency, const TileSpec& tile,
                                                           const RenderPaths& paths, const TileLevels& levels,
                                                           Deadline deadline,
                                                           const DerivedTextureBuilder& buildGradients);

} // namespace voxsheet
