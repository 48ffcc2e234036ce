// Gradients by the renderer's rule: central differences with taps one voxel to both sides along each axis of
// the level's index frame. On axes that do not wrap, a tap beyond the first or the last sample moves to it
// and the difference is divided by the distance that is left.
#pragma once

#include "fields/sources.h"

namespace voxsheet::fields {

/// Six taps at the very point.
[[nodiscard]] GradientAt onTheFlySlope(ValueAt value, const glm::ivec3& levelDims,
                                       const glm::bvec3& periodic);

/// The rule's gradients at the samples, computed at once, trilinear between them.
[[nodiscard]] GradientAt textureSlope(const ValueAt& value, const glm::ivec3& levelDims,
                                      const glm::bvec3& periodic);

/// Of the world, from the gradient in the index frame of a level with these dimensions.
[[nodiscard]] glm::dvec3 worldGradient(const Grid& grid, const glm::ivec3& levelDims,
                                       const glm::dvec3& indexSlope);

} // namespace voxsheet::fields
