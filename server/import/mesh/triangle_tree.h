// A tree of boxes over triangles: the nearest one to a point, and those near each other.
#pragma once

#include "import/mesh/triangle_geometry.h"
#include "import/mesh/triangle_mesh.h"

#include <functional>
#include <span>

namespace voxsheet::import {

struct NearestTriangle {
    std::uint32_t triangle = 0;
    ClosestPoint closest;
};

/// A view: points and triangles must outlive it. Safe to use from several threads.
class TriangleTree {
public:
    /// There is at least one triangle.
    TriangleTree(std::span<const glm::dvec3> points, std::span<const Triangle> triangles);

    /// Exact. \param guess  a triangle that may be near: the nearer, the faster
    [[nodiscard]] NearestTriangle nearest(const glm::dvec3& point, std::uint32_t guess) const;

    /// Calls `found` with each other triangle whose box meets that of `triangle`, until it returns false.
    void visitNeighbours(std::uint32_t triangle, const std::function<bool(std::uint32_t)>& found) const;

    [[nodiscard]] Corners corners(std::uint32_t triangle) const;

private:
    struct Node {
        glm::dvec3 low{0.0};
        glm::dvec3 high{0.0};
        std::uint32_t first = 0; ///< leaf: into order_; else the left child, the right one follows it
        std::uint32_t count = 0; ///< of a leaf's triangles; 0 for inner nodes
    };

    void divide(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
    [[nodiscard]] Node leafOf(std::uint32_t begin, std::uint32_t end) const;
    [[nodiscard]] static double squaredDistance(const Node& node, const glm::dvec3& point);

    std::span<const glm::dvec3> points_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace voxsheet::import
