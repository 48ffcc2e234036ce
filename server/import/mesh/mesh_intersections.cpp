#include "import/mesh/mesh_intersections.h"

#include "import/mesh/triangle_tree.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace voxsheet::import {

namespace {

bool hasArea(const Corners& t) {
    const auto a = t[1] - t[0];
    const auto b = t[2] - t[0];
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(b - a)});
    return glm::length(glm::cross(a, b)) > 1e-12 * longest * longest;
}

/// The corners, beginning with the given point.
Corners beginningWith(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t point) {
    const auto& t = mesh.triangles[triangle];
    const auto first = static_cast<std::size_t>(std::find(t.begin(), t.end(), point) - t.begin());
    return {mesh.points[t[first]], mesh.points[t[(first + 1) % 3]], mesh.points[t[(first + 2) % 3]]};
}

bool meet(const TriangleMesh& mesh, const TriangleTree& tree, std::uint32_t a, std::uint32_t b) {
    int shared = 0;
    std::uint32_t point = 0;
    for (const auto p : mesh.triangles[a])
        for (const auto q : mesh.triangles[b])
            if (p == q) {
                ++shared;
                point = p;
            }
    if (shared > 1 || !hasArea(tree.corners(b))) return false;
    if (shared == 0) return trianglesMeet(tree.corners(a), tree.corners(b));
    return trianglesCutBesideCorner(beginningWith(mesh, a, point), beginningWith(mesh, b, point));
}

} // namespace

MeshIntersections findIntersections(const TriangleMesh& mesh, const ReadProgress& progress) {
    const TriangleTree tree(mesh.points, mesh.triangles);
    std::atomic<std::size_t> count = 0;
    std::mutex mutex;
    auto lowest = static_cast<std::uint32_t>(mesh.triangles.size());
    const auto search = [&](std::uint32_t triangle) {
        if (!hasArea(tree.corners(triangle))) return;
        tree.visitNeighbours(triangle, [&](std::uint32_t other) {
            if (other > triangle && meet(mesh, tree, triangle, other)) {
                ++count;
                const std::lock_guard lock(mutex);
                lowest = std::min(lowest, triangle);
            }
            return count < MeshIntersections::most;
        });
    };
    // In portions, so that progress is told between them.
    constexpr std::size_t portion = 1 << 16;
    for (std::size_t first = 0; first < mesh.triangles.size(); first += portion) {
        const auto end = std::min(first + portion, mesh.triangles.size());
        parallelFor(static_cast<long>(end - first), 256, [&](long from, long to) {
            for (long i = from; i < to; ++i)
                search(static_cast<std::uint32_t>(first + static_cast<std::size_t>(i)));
        });
        if (progress) progress(static_cast<double>(end) / static_cast<double>(mesh.triangles.size()));
    }
    MeshIntersections result{std::min<std::size_t>(count, MeshIntersections::most), {}};
    if (result.count > 0) {
        const auto c = tree.corners(lowest);
        result.place = (c[0] + c[1] + c[2]) / 3.0;
    }
    return result;
}

} // namespace voxsheet::import
