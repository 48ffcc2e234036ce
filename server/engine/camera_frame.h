// What the camera's lengths mean for a cell: its own volume, or what the linked cells have together.
#pragma once

#include "sheet/typed_style.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace voxsheet::engine {

struct CameraFrame {
    glm::dvec3 centreWorld{0.0}; ///< looked at when camera.target is 0
    double radiusWorld = 1.0;    ///< the unit of camera.distance and camera.target, > 0
    /// Of an upright box that every cell with this frame fits into. Pictures of planes then have one scale,
    /// at which the longest edge fits. Not set: they fit the cell's own box.
    std::optional<glm::dvec3> sizeWorld;
};

/// camera.frame fit. \param drawn  the drawn grid (volume/periodic_window.h)
[[nodiscard]] CameraFrame ownFrame(const Grid& drawn);

/// What the volumes of linked cells have together.
struct FrameBounds {
    glm::dvec3 low{0.0}; ///< of the upright box about all of them
    glm::dvec3 high{0.0};
    glm::dvec3 largestSize{0.0}; ///< per axis, of their upright boxes
    double largestRadius = 0.0;  ///< of their bounding spheres
    double radius = 0.0;         ///< about the middle of `low` and `high`, round all bounding spheres
};
/// \param drawn  at least one
[[nodiscard]] FrameBounds boundsOf(const std::vector<Grid>& drawn);

/// Centre: about the cell's own centre, but in one unit of length, so that a millimetre is equally long in
/// every cell. World: one centre, too, so that every cell shows the same part of the world.
[[nodiscard]] CameraFrame linkedFrame(sheet::FrameMode mode, const Grid& own, const FrameBounds& bounds);

} // namespace voxsheet::engine
