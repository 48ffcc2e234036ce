// From a camera and a volume to rays in the texture frame: what camera_rays.glsl is given.
#pragma once

#include "gpu/program.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

namespace voxsheet {

/// The ray of a pixel with picture coordinates q (see pictureHalf) is, in the texture frame,
///   point(s) = (origin + q.x originX + q.y originY) + s (direction + q.x directionX + q.y directionY)
/// where s is the view depth beyond the plane through the centre of the volume's box, in units of the box's
/// bounding radius. The texture frame is that of placedGrid, the box that of drawnGrid. Anchored there,
/// 32-bit floats keep full precision near the volume however far off the eye is and whatever the world's
/// unit.
struct RayFrame {
    glm::dvec2 pictureHalf{
        1.0}; ///< q of the picture's right and upper edge: tangents (perspective), radii (orthographic)
    glm::dvec3 origin{0.0}, originX{0.0}, originY{0.0};
    glm::dvec3 direction{0.0}, directionX{0.0}, directionY{0.0};
    double nearest =
        0.0; ///< s of the eye (perspective: nothing behind it is seen); far before the box (orthographic)
    bool perspective =
        true; ///< world length per unit of s: radiusWorld * sqrt(1 + |q|^2), orthographic radiusWorld
    double radiusWorld = 1.0;      ///< the box's bounding radius
    double centreDepthWorld = 0.0; ///< view depth of the box's centre
    glm::dvec3 boxLow{0.0}; ///< the drawn box in the texture frame; of periodic axes also beyond [0, 1]
    glm::dvec3 boxHigh{1.0};
};

[[nodiscard]] RayFrame makeRayFrame(const CameraSpec& camera, glm::ivec2 sizePixels, const Grid& grid,
                                    const PeriodicWindow& window = {});

/// Sets the uniforms of camera_rays.glsl and box.glsl.
void setRayUniforms(const gpu::Program& program, const RayFrame& frame, glm::ivec2 sizePixels);

/// Voxels of a level that the ray of picture coordinates q passes per unit of s, per axis.
[[nodiscard]] glm::dvec3 voxelsPerDepth(const RayFrame& frame, const glm::ivec3& levelDims,
                                        const glm::dvec2& q);

} // namespace voxsheet
