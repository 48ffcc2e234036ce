#include "import/mesh/mesh_distance.h"

#include "volume/parallel_for.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::import {

namespace {

/// Of unit length; zero for a triangle without area.
glm::dvec3 faceNormal(const Corners& t) {
    const auto normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

double angleAt(const Corners& t, std::size_t corner) {
    const auto a = t[(corner + 1) % 3] - t[corner];
    const auto b = t[(corner + 2) % 3] - t[corner];
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

MeshDistance::MeshDistance(const SolidMesh& solid)
    : solid_(solid), tree_(solid.surface.points, solid.surface.triangles),
      pointNormals_(solid.surface.points.size(), glm::dvec3(0.0)) {
    const auto& triangles = solid.surface.triangles;
    faceNormals_.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto corners = tree_.corners(t);
        faceNormals_.push_back(faceNormal(corners));
        for (std::size_t c = 0; c < 3; ++c)
            pointNormals_[triangles[t][c]] += angleAt(corners, c) * faceNormals_[t];
    }
}

glm::dvec3 MeshDistance::normalOf(const NearestTriangle& nearest) const {
    const auto t = nearest.triangle;
    const auto part = static_cast<unsigned>(nearest.closest.part);
    if (nearest.closest.part == TrianglePart::Face) return faceNormals_[t];
    if (nearest.closest.part <= TrianglePart::Side2) {
        const auto side = 3 * t + part - static_cast<unsigned>(TrianglePart::Side0);
        return faceNormals_[t] + faceNormals_[solid_.edges.partner[side] / 3];
    }
    return pointNormals_[solid_.surface.triangles[t][part - static_cast<unsigned>(TrianglePart::Corner0)]];
}

double MeshDistance::operator()(const glm::dvec3& point, std::uint32_t& guess) const {
    const auto nearest = tree_.nearest(point, guess);
    guess = nearest.triangle;
    const double distance = std::sqrt(nearest.closest.squaredDistance);
    const double side = glm::dot(point - nearest.closest.point, normalOf(nearest));
    return side < 0.0 ? -distance : distance;
}

Grid gridAbout(const Bounds& bounds, int resolution) {
    constexpr double margin = 0.12;
    const auto extent = bounds.high - bounds.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double spacing = longest * (1.0 + 2.0 * margin) / (resolution - 1);
    Grid grid;
    // Rounded up, but not for the sake of rounding errors.
    grid.dims = glm::ivec3(glm::ceil((extent + 2.0 * margin * longest) / spacing - 1e-9)) + 1;
    grid.centring = Centring::Point;
    const auto origin = 0.5 * (bounds.low + bounds.high) - 0.5 * spacing * glm::dvec3(grid.dims - 1);
    grid.worldFromIndex = glm::dmat4(spacing);
    grid.worldFromIndex[3] = glm::dvec4(origin, 1.0);
    validateGrid(grid);
    return grid;
}

std::vector<float> distancesOn(const Grid& grid, const MeshDistance& distance, const ReadProgress& progress) {
    std::vector<float> distances(static_cast<std::size_t>(sampleCount(grid.dims)));
    for (int z = 0; z < grid.dims.z; ++z) {
        parallelFor(grid.dims.y, 1, [&](long begin, long end) {
            for (long y = begin; y < end; ++y) {
                std::uint32_t guess = 0; // then from sample to sample
                const auto row = static_cast<std::size_t>((z * static_cast<long>(grid.dims.y) + y) *
                                                          static_cast<long>(grid.dims.x));
                for (int x = 0; x < grid.dims.x; ++x) {
                    const glm::dvec3 world(grid.worldFromIndex * glm::dvec4(x, y, z, 1.0));
                    distances[row + static_cast<std::size_t>(x)] = static_cast<float>(distance(world, guess));
                }
            }
        });
        if (progress) progress(static_cast<double>(z + 1) / grid.dims.z);
    }
    return distances;
}

} // namespace voxsheet::import
