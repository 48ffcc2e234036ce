#include "import/mesh/mesh_edges.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

struct NamedSide {
    std::uint64_t edge; ///< its two points, the lower one first
    Side side;

    auto operator<=>(const NamedSide&) const = default;
};

std::vector<NamedSide> sortedSides(const std::vector<Triangle>& triangles) {
    std::vector<NamedSide> sides(triangles.size() * 3);
    for (Side side = 0; side < sides.size(); ++side) {
        const std::uint64_t a = beginOf(triangles, side);
        const std::uint64_t b = endOf(triangles, side);
        sides[side] = {(std::min(a, b) << 32U) | std::max(a, b), side};
    }
    std::sort(sides.begin(), sides.end());
    return sides;
}

} // namespace

MeshEdges pairEdges(const std::vector<Triangle>& triangles) {
    const auto sides = sortedSides(triangles);
    MeshEdges edges;
    edges.partner.assign(sides.size(), kNoSide);
    for (std::size_t begin = 0; begin < sides.size();) {
        auto end = begin + 1;
        while (end < sides.size() && sides[end].edge == sides[begin].edge)
            ++end;
        const auto first = sides[begin].side;
        if (end - begin == 1) {
            ++edges.openCount;
            edges.firstOpen = std::min(edges.firstOpen, first);
        } else if (end - begin > 2) {
            ++edges.crowdedCount;
            edges.firstCrowded = std::min(edges.firstCrowded, first);
        } else {
            edges.partner[first] = sides[begin + 1].side;
            edges.partner[sides[begin + 1].side] = first;
        }
        begin = end;
    }
    return edges;
}

} // namespace voxsheet::import
