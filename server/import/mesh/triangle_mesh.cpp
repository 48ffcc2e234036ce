#include "import/mesh/triangle_mesh.h"

#include "base/errors.h"

#include <cstdio>
#include <limits>

namespace voxsheet::import {

Bounds boundsOf(const TriangleMesh& mesh) {
    Bounds bounds{glm::dvec3(std::numeric_limits<double>::infinity()),
                  glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const auto& triangle : mesh.triangles)
        for (const auto corner : triangle) {
            bounds.low = glm::min(bounds.low, mesh.points[corner]);
            bounds.high = glm::max(bounds.high, mesh.points[corner]);
        }
    return bounds;
}

void checkTriangleCount(const std::string& file, std::uint64_t count) {
    if (count <= kMaxTriangles) return;
    throw LimitExceeded(file,
                        "it says that it has " + std::to_string(count) + " triangles, more than the " +
                            std::to_string(kMaxTriangles) + " that an import may have",
                        "simplify the surface first");
}

std::uint32_t addPoint(TriangleMesh& mesh, const glm::dvec3& point, const std::string& file,
                       const std::string& place) {
    constexpr double farthest = 1e30; // volumes and squared areas stay within a double
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (!(std::abs(point[axis]) <= farthest))
            throw InvalidInput(file, "a coordinate at " + place + " is not a finite number, or beyond 1e30",
                               "write the surface again from where it was made");
    if (mesh.points.size() >= 3 * kMaxTriangles)
        throw LimitExceeded(file, "it has more than " + std::to_string(3 * kMaxTriangles) + " points",
                            "simplify the surface first");
    mesh.points.push_back(point);
    return static_cast<std::uint32_t>(mesh.points.size() - 1);
}

void addPolygon(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners, const std::string& file) {
    checkTriangleCount(file, mesh.triangles.size() + corners.size() - 2);
    for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

std::string pointText(const glm::dvec3& point) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", point.x, point.y, point.z);
    return text.data();
}

} // namespace voxsheet::import
