// The convex piece that clip planes leave of a parallelepiped: its faces as closed polygons. Pure arithmetic,
// double precision.
#pragma once

#include "volume/clip.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace voxsheet {

struct PolytopeFace {
    /// 0..5: faces of the box, low and high side of each axis in turn; 6 + i: cut by planes[i].
    int origin = 0;
    glm::dvec3 outwardNormal{0.0}; ///< unit length
    std::vector<glm::dvec3>
        polygon; ///< at least 3 points, convex, planar, counter-clockwise seen from outside
};

struct ConvexPolytope {
    static constexpr int boxFaces = 6;

    std::vector<PolytopeFace> faces; ///< empty when nothing is left, else a closed surface

    [[nodiscard]] bool empty() const { return faces.empty(); }
    /// Volume by the divergence theorem: sum over faces and fan triangles of dot(a, cross(b, c)) / 6.
    [[nodiscard]] double volume() const;
};

/// The part of a grid's drawn box (boxIndex) on the kept side of all planes, in the world. A plane that only
/// touches it leaves it whole; what is left is empty when it has no inside (to 1e-12 of the box's size).
[[nodiscard]] ConvexPolytope clippedBox(const Grid& grid, std::span<const ClipPlane> planes);

} // namespace voxsheet
