// Directions of gradients.
#pragma once

#include <glm/glm.hpp>

namespace voxsheet {

/// From differences of a field per voxel to the direction of its gradient in the view frame: the transposed
/// inverse of the voxels' edges there, scaled to numbers near 1, since only directions matter and a world may
/// be in metres.
[[nodiscard]] glm::mat3 viewFromGradient(const glm::dmat3& viewFromVoxels);

} // namespace voxsheet
