// The values that a cell's picture shows, for ranges that follow the view.
#pragma once

#include "engine/default_look.h"
#include "engine/kept_ray.h"
#include "stages/tile_spec.h"
#include "volume/volume_provider.h"

#include <optional>

namespace voxsheet::engine {

/// Levels with more samples are not read for this: the next coarser one stands for them.
inline constexpr long kVisibleSamples = 1L << 25U;

/// Smallest and largest finite sample within the picture's edges: of technique plane those that lie less
/// than a voxel from the plane (its interpolation uses them), else those that clip planes and clip object
/// keep, however transparent. From the finest level of at most kVisibleSamples samples. Empty if the picture
/// shows none. Throws as VolumeProvider::readSlices.
/// \param object  not null if tile.clip.object is set
[[nodiscard]] std::optional<ValueExtremes> visibleRange(const TileSpec& tile, const DatasetMeta& meta,
                                                        const VolumeProvider& volumes,
                                                        const ObjectSamples* object);

} // namespace voxsheet::engine
