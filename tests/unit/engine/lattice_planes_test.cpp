#include "engine/lattice_planes.h"

#include "base/errors.h"
#include "memory_dataset.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet::engine {
namespace {

const glm::dmat3 kTriclinic{4.0, 0.5, 0.0, -1.0, 5.0, 0.3, 0.7, 1.1, 6.0};

DatasetMeta periodicCell(const glm::dmat3& edges, const glm::ivec3& dims) {
    DatasetMeta meta = test::metaOf("k", dims);
    meta.grid.periodic = glm::bvec3(true);
    for (int axis = 0; axis < 3; ++axis)
        meta.grid.worldFromIndex[axis] = glm::dvec4(edges[axis] / static_cast<double>(dims[axis]), 0.0);
    return meta;
}

TEST(LatticePlanes, PointsOfAPlaneHaveWholeSumsOfIndicesTimesFractions) {
    for (const glm::dvec3 hkl : {glm::dvec3(1, 1, 1), glm::dvec3(2, -1, 0), glm::dvec3(0, 0, -3)}) {
        const auto planes = latticePlanes(kTriclinic, hkl);
        EXPECT_NEAR(glm::length(planes.normal), 1.0, 1e-12);
        for (const glm::dvec3 f : {glm::dvec3(0.2, 0.7, -0.4), glm::dvec3(1, 2, 3)})
            EXPECT_NEAR(glm::dot(planes.normal, kTriclinic * f), glm::dot(hkl, f) * planes.spacing, 1e-12);
    }
}

TEST(LatticePlanes, DistancesAreThoseOfTheTextbooks) {
    // Cubic: a / sqrt(h^2 + k^2 + l^2); hexagonal: 1 / sqrt(4/3 (h^2 + hk + k^2) / a^2 + l^2 / c^2).
    const glm::dmat3 cubic(6.48);
    EXPECT_NEAR(latticePlanes(cubic, {1, 1, 1}).spacing, 6.48 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(latticePlanes(cubic, {2, 2, 0}).spacing, 6.48 / std::sqrt(8.0), 1e-12);
    const double a = 3.2;
    const double c = 5.2;
    const glm::dmat3 hexagonal{a, 0, 0, -a / 2.0, a * std::sqrt(0.75), 0, 0, 0, c};
    EXPECT_NEAR(latticePlanes(hexagonal, {1, 1, 2}).spacing,
                1.0 / std::sqrt(4.0 / 3.0 * 3.0 / (a * a) + 4.0 / (c * c)), 1e-12);
}

TEST(LatticePlanes, TheLatticeIsThatOfTheFileElseThePeriodsOfTheGrid) {
    DatasetMeta meta = periodicCell(kTriclinic, {10, 20, 30});
    const auto periods = latticeOf(meta);
    ASSERT_TRUE(periods);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(glm::distance((*periods)[axis], kTriclinic[axis]), 0.0, 1e-12);
    meta.crystal = Crystal{kTriclinic / 2.0, {}, ""}; // The grid holds a supercell.
    EXPECT_EQ(latticeOf(meta), kTriclinic / 2.0);
    meta.grid.periodic.z = false;
    EXPECT_FALSE(latticeOf(meta)) << "a molecule in a box, or a part of a crystal";
}

TEST(LatticePlanes, AStyleTakesTheNormalOfItsIndices) {
    const DatasetMeta meta = periodicCell(kTriclinic, {10, 20, 30});
    sheet::PlaneStyle plane;
    plane.axis = sheet::PlaneAxis::Hkl;
    plane.hkl = {1, 2, 0};
    const auto custom = withLatticeNormal(plane, meta);
    EXPECT_EQ(custom.axis, sheet::PlaneAxis::Custom);
    EXPECT_NEAR(glm::dot(custom.normal, kTriclinic[2]), 0.0, 1e-12) << "l = 0: along c";
    plane.axis = sheet::PlaneAxis::Coronal;
    EXPECT_EQ(withLatticeNormal(plane, test::metaOf("k", {4, 4, 4})), plane);
    plane.axis = sheet::PlaneAxis::Hkl;
    EXPECT_THROW((void)withLatticeNormal(plane, test::metaOf("k", {4, 4, 4})), InvalidInput);
}

} // namespace
} // namespace voxsheet::engine
