// Which triangles meet in which edges.
#pragma once

#include "import/mesh/triangle_mesh.h"

#include <limits>

namespace voxsheet::import {

/// Names side s of triangle t, from its corner s to its corner s + 1 (mod 3): 3 t + s.
using Side = std::uint32_t;
inline constexpr Side kNoSide = std::numeric_limits<Side>::max();

struct MeshEdges {
    /// Per side: the side of the other triangle on the same edge; kNoSide where there are not exactly two.
    std::vector<Side> partner;
    std::size_t openCount = 0;    ///< edges of one triangle only
    std::size_t crowdedCount = 0; ///< edges of more than two triangles
    Side firstOpen = kNoSide;     ///< on the open edge of the lowest triangle
    Side firstCrowded = kNoSide;
};

[[nodiscard]] MeshEdges pairEdges(const std::vector<Triangle>& triangles);

/// Corners where a side begins and ends.
[[nodiscard]] inline std::uint32_t beginOf(const std::vector<Triangle>& triangles, Side side) {
    return triangles[side / 3][side % 3];
}
[[nodiscard]] inline std::uint32_t endOf(const std::vector<Triangle>& triangles, Side side) {
    return triangles[side / 3][(side % 3 + 1) % 3];
}

} // namespace voxsheet::import
