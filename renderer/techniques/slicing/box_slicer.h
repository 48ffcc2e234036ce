// Polygons in which planes at equal distances cut a box, by an incremental sweep. Pure arithmetic, no GL.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace voxsheet {

/// Eight corners of a parallelepiped in a frame whose z is the depth; bit a of a corner's index: at the high
/// end of axis a.
using BoxCorners = std::array<glm::dvec3, 8>;

/// Where the planes are: plane k, any integer, at depth anchor + (k + 1/2) * spacing.
struct SlicePlanes {
    double anchor = 0.0;
    double spacing = 1.0; ///< > 0
    double nearest = 0.0; ///< only planes beyond this depth are cut
};

struct Slice {
    double depth = 0.0;
    int points = 0;                 ///< 3 to 6
    std::array<glm::dvec2, 6> ring; ///< x, y of the corners of the convex polygon, in order around it
};

/// The slices from the farthest to the nearest plane. Between two corners of the box (sorted by depth) the
/// planes cut the same ring of edges, so that each point moves by a constant step from plane to plane; the
/// ring is found anew only when a corner is passed. Throws InvalidInput if it would be more than 2^20 slices.
[[nodiscard]] std::vector<Slice> sliceBox(const BoxCorners& corners, const SlicePlanes& planes);

} // namespace voxsheet
