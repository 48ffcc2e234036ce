// Lattices of crystals, and their planes by Miller indices.
#pragma once

#include "sheet/typed_style.h"
#include "volume/dataset.h"

#include <glm/glm.hpp>

#include <optional>

namespace voxsheet::engine {

/// The lattice that Miller indices of a dataset refer to, columns a, b, c in world units: that of its file,
/// or the periods of its grid where the file names none. Only of grids that are periodic along all axes.
[[nodiscard]] std::optional<glm::dmat3> latticeOf(const DatasetMeta& meta);

/// (hkl): the planes hkl . f = whole number, with f the fractions of a point along a, b, c. They stand at
/// right angles to the vector h a* + k b* + l c* of the reciprocal lattice.
struct LatticePlanes {
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< along that vector, unit length, world
    double spacing = 1.0;             ///< distance of neighbours: 1 / its length, world units
};
/// \param hkl  not all zero
[[nodiscard]] LatticePlanes latticePlanes(const glm::dmat3& lattice, const glm::dvec3& hkl);

/// The style with the normal of plane.hkl as that of a custom plane, where it asks for one; else as it is.
/// Throws InvalidInput (field plane.axis) if the dataset has no lattice.
[[nodiscard]] sheet::PlaneStyle withLatticeNormal(sheet::PlaneStyle plane, const DatasetMeta& meta);

} // namespace voxsheet::engine
