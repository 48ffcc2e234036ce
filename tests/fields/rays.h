// Rays of pixels in the world, and what box and clip planes leave of them, in double precision.
#pragma once

#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

namespace voxsheet::fields {

/// point(s) = origin + s * direction, s = view depth in world units.
struct WorldRay {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0};

    [[nodiscard]] glm::dvec3 at(double depth) const { return origin + depth * direction; }
};

/// Of the point (x, y) of the picture in pixels from its lower left corner; centres at halves.
[[nodiscard]] WorldRay worldRay(const TileSpec& tile, double x, double y);

/// Unit direction from any point of the ray to the eye.
[[nodiscard]] glm::dvec3 toEye(const TileSpec& tile, const WorldRay& ray);

/// Depths inside the drawn box, on the kept side of all clip planes, in front of the eye; end <= begin:
/// nothing.
struct KeptRange {
    double begin = 0.0;
    double end = 0.0;
    int cutPlane = -1;    ///< the ray enters through this clip plane; -1: it does not
    bool fromEye = false; ///< the eye is inside
    glm::dvec3 entryNormal{
        0.0}; ///< unit normal of the face that the ray enters through, outward, world; 0: the eye
    glm::dvec3 exitNormal{0.0}; ///< likewise where it leaves
};
[[nodiscard]] KeptRange keptRange(const TileSpec& tile, const Grid& grid, const WorldRay& ray);

} // namespace voxsheet::fields
