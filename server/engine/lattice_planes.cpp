#include "engine/lattice_planes.h"

#include "base/errors.h"

namespace voxsheet::engine {

std::optional<glm::dmat3> latticeOf(const DatasetMeta& meta) {
    const Grid& grid = meta.grid;
    if (!glm::all(grid.periodic)) return std::nullopt;
    if (meta.crystal && glm::determinant(meta.crystal->lattice) != 0.0) return meta.crystal->lattice;
    glm::dmat3 periods;
    for (int axis = 0; axis < 3; ++axis)
        periods[axis] = glm::dvec3(grid.worldFromIndex[axis]) * static_cast<double>(grid.dims[axis]);
    return periods;
}

LatticePlanes latticePlanes(const glm::dmat3& lattice, const glm::dvec3& hkl) {
    // The rows of the inverse are a*, b*, c*.
    const glm::dvec3 reciprocal = glm::transpose(glm::inverse(lattice)) * hkl;
    const double length = glm::length(reciprocal);
    return {reciprocal / length, 1.0 / length};
}

sheet::PlaneStyle withLatticeNormal(sheet::PlaneStyle plane, const DatasetMeta& meta) {
    if (plane.axis != sheet::PlaneAxis::Hkl) return plane;
    const auto lattice = latticeOf(meta);
    if (!lattice)
        throw InvalidInput("plane.axis",
                           "hkl planes need a lattice, and this volume is not periodic along all of its axes",
                           "choose axial, coronal, sagittal or custom for this cell, or import the file with "
                           "the option periodic")
            .withField("plane.axis");
    plane.normal = latticePlanes(*lattice, plane.hkl).normal;
    plane.axis = sheet::PlaneAxis::Custom;
    return plane;
}

} // namespace voxsheet::engine
