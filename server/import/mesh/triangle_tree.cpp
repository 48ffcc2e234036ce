#include "import/mesh/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace voxsheet::import {

namespace {

constexpr std::uint32_t leafTriangles = 4;
constexpr std::size_t deepest = 64; // halving: 2^32 triangles at most

} // namespace

TriangleTree::TriangleTree(std::span<const glm::dvec3> points, std::span<const Triangle> triangles)
    : points_(points), triangles_(triangles), order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(order_.size());
    nodes_.emplace_back();
    divide(0, 0, static_cast<std::uint32_t>(order_.size()));
}

Corners TriangleTree::corners(std::uint32_t triangle) const {
    const auto& t = triangles_[triangle];
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
}

TriangleTree::Node TriangleTree::leafOf(std::uint32_t begin, std::uint32_t end) const {
    Node node{glm::dvec3(std::numeric_limits<double>::infinity()),
              glm::dvec3(-std::numeric_limits<double>::infinity()), begin, end - begin};
    for (auto i = begin; i < end; ++i)
        for (const auto& corner : corners(order_[i])) {
            node.low = glm::min(node.low, corner);
            node.high = glm::max(node.high, corner);
        }
    return node;
}

void TriangleTree::divide(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    nodes_[node] = leafOf(begin, end);
    if (end - begin <= leafTriangles) return;
    const auto extent = nodes_[node].high - nodes_[node].low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto middle = begin + (end - begin) / 2;
    const auto centre = [&](std::uint32_t triangle) {
        const auto c = corners(triangle);
        return c[0][axis] + c[1][axis] + c[2][axis];
    };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = left;
    nodes_[node].count = 0;
    divide(left, begin, middle);
    divide(left + 1, middle, end);
}

double TriangleTree::squaredDistance(const Node& node, const glm::dvec3& point) {
    const auto outside = glm::max(glm::max(node.low - point, point - node.high), 0.0);
    return glm::dot(outside, outside);
}

NearestTriangle TriangleTree::nearest(const glm::dvec3& point, std::uint32_t guess) const {
    NearestTriangle best{guess, closestPoint(point, corners(guess))};
    std::array<std::pair<double, std::uint32_t>, deepest> waiting;
    std::size_t count = 0;
    waiting[count++] = {squaredDistance(nodes_[0], point), 0U};
    while (count > 0) {
        const auto [distance, index] = waiting[--count];
        if (distance >= best.closest.squaredDistance) continue;
        const auto& node = nodes_[index];
        if (node.count == 0) {
            std::pair near{squaredDistance(nodes_[node.first], point), node.first};
            std::pair far{squaredDistance(nodes_[node.first + 1], point), node.first + 1};
            if (far.first < near.first) std::swap(near, far);
            waiting[count++] = far;
            waiting[count++] = near;
            continue;
        }
        for (auto i = node.first; i < node.first + node.count; ++i) {
            const auto closest = closestPoint(point, corners(order_[i]));
            if (closest.squaredDistance < best.closest.squaredDistance) best = {order_[i], closest};
        }
    }
    return best;
}

void TriangleTree::visitNeighbours(std::uint32_t triangle,
                                   const std::function<bool(std::uint32_t)>& found) const {
    const auto own = corners(triangle);
    const auto low = glm::min(glm::min(own[0], own[1]), own[2]);
    const auto high = glm::max(glm::max(own[0], own[1]), own[2]);
    const auto meets = [&](const glm::dvec3& otherLow, const glm::dvec3& otherHigh) {
        return glm::all(glm::lessThanEqual(low, otherHigh)) && glm::all(glm::lessThanEqual(otherLow, high));
    };
    std::array<std::uint32_t, deepest> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const auto& node = nodes_[waiting[--count]];
        if (!meets(node.low, node.high)) continue;
        if (node.count == 0) {
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1;
            continue;
        }
        for (auto i = node.first; i < node.first + node.count; ++i) {
            const auto other = corners(order_[i]);
            if (order_[i] != triangle &&
                meets(glm::min(glm::min(other[0], other[1]), other[2]),
                      glm::max(glm::max(other[0], other[1]), other[2])) &&
                !found(order_[i]))
                return;
        }
    }
}

} // namespace voxsheet::import
