// Where a surface cuts itself.
#pragma once

#include "import/mesh/triangle_mesh.h"
#include "import/source_reader.h"

namespace voxsheet::import {

struct MeshIntersections {
    static constexpr std::size_t most = 10'000; ///< the search ends there
    std::size_t count = 0;                      ///< pairs of triangles
    glm::dvec3 place{0.0};                      ///< centre of the lowest such triangle
};

/// Pairs that meet without sharing a corner, or cut each other beside the one corner that they share. Pairs
/// that share an edge are not looked at, nor triangles without area. \param progress  0 .. 1; may be empty
[[nodiscard]] MeshIntersections findIntersections(const TriangleMesh& mesh, const ReadProgress& progress);

} // namespace voxsheet::import
