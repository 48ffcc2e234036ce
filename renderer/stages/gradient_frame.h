// Directions of gradients.
#pragma once

#include "volume/grid.h"

#include <glm/glm.hpp>

namespace voxsheet {

/// Edges of the voxels of a level with so many samples in the view frame, as columns.
[[nodiscard]] glm::dmat3 viewFromVoxels(const glm::dmat4& viewFromWorld, const Grid& grid,
                                        const glm::ivec3& levelSamples);

/// From differences of a field per voxel to the direction of its gradient in the view frame: the transposed
/// inverse of the voxels' edges there, scaled to numbers near 1, since only directions matter and a world may
/// be in metres.
[[nodiscard]] glm::mat3 viewFromGradient(const glm::dmat3& voxelsInView);

} // namespace voxsheet
