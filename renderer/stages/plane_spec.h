// The cut that technique plane shows.
#pragma once

#include <glm/glm.hpp>

namespace voxsheet {

enum class PlaneInterpolation {
    Linear, ///< trilinear between samples
    /// The value of the voxel that holds the point. Points on the border of two voxels, or less than 1/1024
    /// voxel below it, show the one of higher index: rounding must not speckle planes that lie in a border.
    Nearest
};

/// The points p of the world with dot(normal, p) = offset.
struct PlaneSpec {
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< unit length, world
    double offset = 0.0;              ///< world units
    PlaneInterpolation interpolation = PlaneInterpolation::Linear;
};

/// Throws InvalidInput (field plane.normal or plane.position) unless the normal has unit length to 1e-6 and
/// the offset is finite.
void validatePlane(const PlaneSpec& plane);

} // namespace voxsheet
