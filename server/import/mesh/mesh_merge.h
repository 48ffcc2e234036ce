// Surface files repeat the points that triangles share; here they become one again.
#pragma once

#include "import/mesh/triangle_mesh.h"

namespace voxsheet::import {

struct MergeCounts {
    std::size_t points = 0;    ///< merged into others
    std::size_t triangles = 0; ///< dropped, because two of their corners are one point now
};

/// Merges points at equal positions, or, with a tolerance > 0, a point with an earlier one at most that far
/// away. Drops points that no triangle uses and triangles with two equal corners.
MergeCounts mergePoints(TriangleMesh& mesh, double tolerance);

} // namespace voxsheet::import
