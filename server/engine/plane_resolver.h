// From a cell's plane style to a plane in the world of its volume and a camera that faces it.
#pragma once

#include "engine/camera_frame.h"
#include "sheet/typed_style.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

namespace voxsheet::engine {

/// How a plane lies in the picture; orthonormal and right-handed, towardsEye = cross(right, up). World axes.
struct PlaneView {
    glm::dvec3 right{1.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 towardsEye{0.0, 0.0, 1.0};
};

/// Axis       normal   anatomical (RAS+): right, up         other data: right, up
/// Axial      +z       -x, +y (from the feet)               +x, +y
/// Coronal    +y       -x, +z (from the front)              +x, +z
/// Sagittal   +x       -y, +z (from the patient's left)     +y, +z
/// Custom     given    the eye is where the normal points; up is the world's z as seen there, or y where
///                     the normal is parallel to z
/// Anatomical pictures are in the radiological convention: the patient's right is on the picture's left.
[[nodiscard]] PlaneView planeView(const sheet::PlaneStyle& plane, bool anatomical);

/// Hkl planes come as custom ones (withLatticeNormal).
///
/// The grids below are the drawn ones (volume/periodic_window.h).

/// The normal is that of the table above, whichever side the eye is on: position rises along it.
[[nodiscard]] PlaneSpec resolvePlane(const sheet::PlaneStyle& plane, const Grid& grid);

/// Orthographic. At the default camera.distance the drawn box fits the picture with a narrow margin; half the
/// distance shows half of that. A frame with a size shows that size's longest edge instead. camera.target
/// moves the picture by what of it lies in the plane; the camera's angles, field of view and projection mean
/// nothing.
[[nodiscard]] CameraSpec resolvePlaneCamera(const sheet::PlaneStyle& plane, const sheet::CameraStyle& camera,
                                            const Grid& grid, bool anatomical, glm::ivec2 sizePixels,
                                            const CameraFrame& frame);

} // namespace voxsheet::engine
