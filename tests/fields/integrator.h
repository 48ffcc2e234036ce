// The truth for pictures: emission and absorption (or the maximum) along rays, in double precision on the
// CPU. Written from the definitions of the techniques' headers and shares no code with them but the grid, the
// table and the camera's meaning.
#pragma once

#include "fields/picture.h"
#include "fields/sampled_field.h"
#include "fields/sources.h"
#include "stages/tile_spec.h"

namespace voxsheet::fields {

/// The picture with samples exactly where `tile.technique` puts them, in a level of `levelDims` samples. No
/// early end of rays.
[[nodiscard]] Picture integrateLikeTechnique(const TileSpec& tile, const Grid& grid,
                                             const glm::ivec3& levelDims, const ValueAt& value);

/// The same picture with stretches of `stepVoxels` voxels, from the front of the box to its back: converged
/// as the step goes to 0. Maximum projection takes the largest of all samples.
[[nodiscard]] Picture integrateConverged(const TileSpec& tile, const Grid& grid, const glm::ivec3& levelDims,
                                         const ValueAt& value, double stepVoxels = 1.0 / 24.0,
                                         int everyNthPixel = 1);

/// Voxels of the level that all rays of the picture pass inside the box, in sum: divided by the distance of
/// samples, their number.
[[nodiscard]] double pathVoxels(const TileSpec& tile, const Grid& grid, const glm::ivec3& levelDims);

} // namespace voxsheet::fields
