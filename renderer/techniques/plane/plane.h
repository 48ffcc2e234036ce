// A plane through the volume by a compute shader: the values where it cuts the drawn box, as colours.
//
// Each pixel shows the table's rgb, opaque whatever the table's opacity, of the value where its ray meets
// TileSpec::plane; a value that is NaN the table's colour for it, premultiplied. Where the ray meets the
// plane outside the drawn box, or the plane is seen edge-on, the pixel is transparent. A point counts as
// inside up to 1e-5 of the box's dims beyond its faces, so that a plane in a face is seen. Nothing clips or
// lights it. Of categories the nearest samples, clear where the table is. Layers (stages/layer_spec.h) are
// painted over it.
#pragma once

#include "stages/shared_stages.h"

#include <optional>

namespace voxsheet {

/// Where the points of a picture lie on the plane, in the texture frame:
/// origin + q.x right + q.y up for picture coordinates q (stages/ray_frame.h).
struct PlaneInPicture {
    glm::dvec3 origin{0.0};
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};
};

/// \param frame  of an orthographic camera
/// \param grid   the placed one (volume/periodic_window.h), as the frame's texture frame
/// Empty if the plane is seen edge-on.
[[nodiscard]] std::optional<PlaneInPicture> planeInPicture(const PlaneSpec& plane, const RayFrame& frame,
                                                           const Grid& grid);

/// Throws InvalidInput (field camera.projection) unless the camera is orthographic.
void drawPlane(SharedStages& stages, const DrawRequest& request);

} // namespace voxsheet
