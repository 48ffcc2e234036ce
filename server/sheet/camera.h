// From camera keys to a view of the world.
//
// World axes as the dataset has them, z up. Azimuth 0, elevation 0 looks along +y with x to the right
// (ParaView's
// "+Y" view). Azimuth turns the eye about +z, counter-clockwise seen from above: at 90 degrees it stands on
// +x. Elevation lifts it: at 90 degrees it looks straight down. Roll turns the eye clockwise about its line
// of sight.
#pragma once

#include "sheet/typed_style.h"

#include <glm/glm.hpp>

namespace voxsheet::sheet {

struct CameraPose {
    glm::dvec3 eyeWorld{0.0};
    glm::dvec3 targetWorld{0.0};
    glm::dvec3 upWorld{0.0, 0.0, 1.0};  ///< unit, at right angles to the line of sight
    glm::dmat4 viewFromWorld{1.0};      ///< rigid; looks along -z, x right, y up
    double orthographicHeightWorld = 1; ///< what perspective shows at the target's distance: 2 d tan(fov / 2)
};

/// \param centreWorld, radiusWorld  the dataset's bounding sphere; radius > 0
[[nodiscard]] CameraPose cameraPose(const CameraStyle& camera, const glm::dvec3& centreWorld,
                                    double radiusWorld);

} // namespace voxsheet::sheet
