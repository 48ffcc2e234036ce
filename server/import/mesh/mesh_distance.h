// Exact signed distances to the surface of a solid.
#pragma once

#include "import/mesh/solid_mesh.h"
#include "import/mesh/triangle_tree.h"
#include "volume/grid.h"

#include <vector>

namespace voxsheet::import {

/// Euclidean, negative inside. The sign is that of the normal of the nearest part, face, edge or point, where
/// an edge has the sum of its faces' normals and a point the sum weighted by their angles (Baerentzen &
/// Aanaes, "Signed Distance Computation Using the Angle Weighted Pseudonormal", IEEE TVCG 11, 2005). Safe to
/// use from several threads.
class MeshDistance {
public:
    /// \param solid  must outlive it
    explicit MeshDistance(const SolidMesh& solid);

    /// \param guess  a triangle that may be near; on return the nearest one
    [[nodiscard]] double operator()(const glm::dvec3& point, std::uint32_t& guess) const;

private:
    [[nodiscard]] glm::dvec3 normalOf(const NearestTriangle& nearest) const;

    const SolidMesh& solid_;
    TriangleTree tree_;
    std::vector<glm::dvec3> faceNormals_;
    std::vector<glm::dvec3> pointNormals_;
};

/// An isotropic point-centred grid about the bounds, with a margin of 12 % of the longest axis on each side
/// and `resolution` samples along that axis.
[[nodiscard]] Grid gridAbout(const Bounds& bounds, int resolution);

/// Distances at the samples of a grid, x fastest.
[[nodiscard]] std::vector<float> distancesOn(const Grid& grid, const MeshDistance& distance,
                                             const ReadProgress& progress);

} // namespace voxsheet::import
