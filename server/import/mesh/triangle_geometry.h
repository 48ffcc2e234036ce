// Distances to one triangle, and whether two of them meet.
#pragma once

#include <glm/glm.hpp>

#include <array>

namespace voxsheet::import {

using Corners = std::array<glm::dvec3, 3>;

enum class TrianglePart {
    Face,
    Side0,
    Side1,
    Side2,
    Corner0,
    Corner1,
    Corner2
}; ///< side s: corner s to s + 1

struct ClosestPoint {
    glm::dvec3 point{0.0};
    double squaredDistance = 0.0;
    TrianglePart part = TrianglePart::Face;
};

/// By the Voronoi regions of the triangle's parts (Ericson, Real-Time Collision Detection, 2005, section
/// 5.1.5). A triangle without area counts as its sides.
[[nodiscard]] ClosestPoint closestPoint(const glm::dvec3& point, const Corners& triangle);

/// Whether two triangles without a common corner have a point in common. What is coplanar up to rounding must
/// overlap by an area.
[[nodiscard]] bool trianglesMeet(const Corners& a, const Corners& b);

/// Whether two triangles that have exactly their first corners in common cut each other elsewhere.
[[nodiscard]] bool trianglesCutBesideCorner(const Corners& a, const Corners& b);

} // namespace voxsheet::import
