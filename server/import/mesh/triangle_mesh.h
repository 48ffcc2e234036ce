// Triangles of a surface file, as they stand there.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet::import {

using Triangle = std::array<std::uint32_t, 3>; ///< indices of points, anticlockwise seen from outside

struct TriangleMesh {
    std::vector<glm::dvec3> points; ///< finite; in the file's own unit of length
    std::vector<Triangle> triangles;
    std::vector<std::string> notes; ///< what the parser did that a user should know, one sentence each

    [[nodiscard]] const glm::dvec3& corner(std::size_t triangle, std::size_t index) const {
        return points[triangles[triangle][index]];
    }
};

struct Bounds {
    glm::dvec3 low;
    glm::dvec3 high;
};

/// Of the points that triangles use; the mesh has at least one triangle.
[[nodiscard]] Bounds boundsOf(const TriangleMesh& mesh);

/// More would take too long to check; a file that says so is refused before anything is allocated.
inline constexpr std::uint64_t kMaxTriangles = 10'000'000;

/// Throws LimitExceeded (subject `file`) above kMaxTriangles.
void checkTriangleCount(const std::string& file, std::uint64_t count);

/// Adds a point; returns its index. Throws InvalidInput (subject `file`) if a coordinate is not finite or
/// beyond 1e30; `place` says where it is, e.g. "line 12".
std::uint32_t addPoint(TriangleMesh& mesh, const glm::dvec3& point, const std::string& file,
                       const std::string& place);

/// Adds a convex polygon as a fan of triangles about its first corner. Throws as checkTriangleCount.
void addPolygon(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners, const std::string& file);

/// "(1.5, 0, -2)": in messages.
[[nodiscard]] std::string pointText(const glm::dvec3& point);

} // namespace voxsheet::import
