#include "import/mesh/mesh_merge.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace voxsheet::import {

namespace {

using PointMap = std::vector<std::uint32_t>; ///< per point: the one that stands for it, not a later one

PointMap equalPoints(const std::vector<glm::dvec3>& points) {
    PointMap order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const auto& p = points[a];
        const auto& q = points[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        if (p.z != q.z) return p.z < q.z;
        return a < b;
    };
    std::sort(order.begin(), order.end(), before);
    PointMap map(points.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        map[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? map[order[i - 1]] : order[i];
    return map;
}

/// Points that stand for others, by cubes of twice the tolerance.
class PointCubes {
public:
    PointCubes(const std::vector<glm::dvec3>& points, double tolerance)
        : points_(points), tolerance_(tolerance) {}

    /// An earlier point within the tolerance, or this one itself, which then stands for later ones.
    std::uint32_t representative(std::uint32_t index) {
        const auto& point = points_[index];
        const auto low = glm::floor((point - tolerance_) / (2.0 * tolerance_));
        const auto high = glm::floor((point + tolerance_) / (2.0 * tolerance_));
        for (double z = low.z; z <= high.z; ++z)
            for (double y = low.y; y <= high.y; ++y)
                for (double x = low.x; x <= high.x; ++x) {
                    const auto [begin, end] = cubes_.equal_range(keyOf({x, y, z}));
                    for (auto each = begin; each != end; ++each)
                        if (glm::distance(points_[each->second], point) <= tolerance_) return each->second;
                }
        cubes_.emplace(keyOf(glm::floor(point / (2.0 * tolerance_))), index);
        return index;
    }

private:
    /// Equal keys of different cubes cost time only.
    [[nodiscard]] static std::size_t keyOf(const glm::dvec3& cube) {
        const std::hash<double> hash;
        return hash(cube.x) * 73856093U ^ hash(cube.y) * 19349663U ^ hash(cube.z) * 83492791U;
    }

    const std::vector<glm::dvec3>& points_;
    double tolerance_;
    std::unordered_multimap<std::size_t, std::uint32_t> cubes_;
};

PointMap closePoints(const std::vector<glm::dvec3>& points, double tolerance) {
    PointCubes cubes(points, tolerance);
    PointMap map(points.size());
    for (std::uint32_t i = 0; i < map.size(); ++i)
        map[i] = cubes.representative(i);
    return map;
}

void dropUnusedPoints(TriangleMesh& mesh) {
    constexpr std::uint32_t unused = 0xffffffffU;
    PointMap placed(mesh.points.size(), unused);
    std::vector<glm::dvec3> kept;
    for (auto& triangle : mesh.triangles)
        for (auto& corner : triangle) {
            if (placed[corner] == unused) {
                placed[corner] = static_cast<std::uint32_t>(kept.size());
                kept.push_back(mesh.points[corner]);
            }
            corner = placed[corner];
        }
    mesh.points = std::move(kept);
}

} // namespace

MergeCounts mergePoints(TriangleMesh& mesh, double tolerance) {
    const auto map = tolerance > 0.0 ? closePoints(mesh.points, tolerance) : equalPoints(mesh.points);
    MergeCounts counts;
    for (std::uint32_t i = 0; i < map.size(); ++i)
        if (map[i] != i) ++counts.points;
    for (auto& triangle : mesh.triangles)
        for (auto& corner : triangle)
            corner = map[corner];
    counts.triangles = std::erase_if(
        mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    dropUnusedPoints(mesh);
    return counts;
}

} // namespace voxsheet::import
