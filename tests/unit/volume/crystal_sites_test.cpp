#include "volume/crystal_sites.h"

#include "base/errors.h"
#include "volume/elements.h"
#include "volume/neighbour_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace voxsheet {
namespace {

constexpr double kEdge = 6.48; ///< Å, of the cubic cell of CdTe
constexpr int kCd = 48;
constexpr int kTe = 52;
const glm::dvec3 kFcc[] = {{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}};

/// Zinc blende in its cubic cell, sheared if asked.
Crystal zincBlende(const glm::dmat3& lattice = glm::dmat3(kEdge)) {
    Crystal crystal;
    crystal.lattice = lattice;
    for (const glm::dvec3& corner : kFcc)
        crystal.atoms.push_back({kCd, lattice * corner});
    for (const glm::dvec3& corner : kFcc)
        crystal.atoms.push_back({kTe, lattice * (corner + 0.25)});
    return crystal;
}

Grid gridOver(const glm::dmat3& cell, const glm::bvec3& periodic = glm::bvec3(true)) {
    Grid grid;
    grid.dims = {20, 24, 30};
    for (int axis = 0; axis < 3; ++axis)
        grid.worldFromIndex[axis] = glm::dvec4(cell[axis] / static_cast<double>(grid.dims[axis]), 0.0);
    grid.periodic = periodic;
    return grid;
}

std::size_t countOf(const CrystalSites& found, int atomicNumber, bool inBox = true) {
    return static_cast<std::size_t>(
        std::count_if(found.sites.begin(), found.sites.end(), [&](const CrystalSite& site) {
            return site.atomicNumber == atomicNumber && site.inBox == inBox;
        }));
}

bool has(const CrystalSites& found, const glm::dvec3& position) {
    return std::any_of(found.sites.begin(), found.sites.end(), [&](const CrystalSite& site) {
        return glm::distance(site.positionWorld, position) < 1e-9;
    });
}

TEST(Elements, HaveTheirSymbolsRadiiAndColours) {
    EXPECT_EQ(atomicNumber("Cd"), kCd);
    EXPECT_EQ(atomicNumber("cd"), 0);
    EXPECT_EQ(atomicNumber(""), 0);
    for (int number = 1; number <= kHeaviestElement; ++number) {
        const Element element = elementOf(number);
        EXPECT_EQ(atomicNumber(element.symbol), number);
        EXPECT_GT(element.covalentRadius, 0.2);
        EXPECT_LT(element.covalentRadius, 2.7);
    }
    EXPECT_STREQ(elementOf(118).symbol, "Og");
    EXPECT_DOUBLE_EQ(elementOf(8).covalentRadius, 0.66);
    EXPECT_EQ(elementOf(6).colour, glm::dvec3(0x90 / 255.0));
    for (const int none : {0, -1, 119}) {
        EXPECT_STREQ(elementOf(none).symbol, "");
        EXPECT_GT(elementOf(none).covalentRadius, 0.0);
    }
}

TEST(NeighbourCells, FindThePairsThatAllPairsHold) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-3.0, 4.0);
    std::vector<glm::dvec3> points(400);
    for (glm::dvec3& point : points)
        point = {anywhere(random), 0.2 * anywhere(random), anywhere(random)};
    points.push_back(points.front());
    for (const double reach : {0.05, 0.7, 30.0}) {
        std::set<std::pair<std::size_t, std::size_t>> found;
        std::size_t visits = 0;
        forEachPairWithin(points, reach, [&](std::size_t i, std::size_t j) {
            found.emplace(i, j);
            ++visits;
        });
        EXPECT_EQ(visits, found.size());
        std::size_t expected = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = i + 1; j < points.size(); ++j)
                if (glm::distance(points[i], points[j]) <= reach) {
                    ++expected;
                    EXPECT_TRUE(found.contains({i, j}));
                }
        EXPECT_EQ(found.size(), expected);
    }
    forEachPairWithin({}, 1.0, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(CrystalSites, AtomsInAFaceAreInTheOppositeOneToo) {
    const Crystal crystal = zincBlende();
    const auto found = crystalSites(crystal, gridOver(crystal.lattice), {}, BondReach::InBox);
    EXPECT_EQ(countOf(found, kCd), 14U) << "8 corners and 6 faces";
    EXPECT_EQ(countOf(found, kTe), 4U);
    EXPECT_TRUE(has(found, glm::dvec3(kEdge)));
    EXPECT_TRUE(has(found, kEdge * glm::dvec3(0.5, 1.0, 0.5)));
    EXPECT_EQ(found.bonds.size(), 16U) << "four of each Te";
    for (const CrystalBond& bond : found.bonds) {
        const auto& [a, b] = std::pair(found.sites[bond.first], found.sites[bond.second]);
        EXPECT_NE(a.atomicNumber, b.atomicNumber);
        EXPECT_NEAR(glm::distance(a.positionWorld, b.positionWorld), kEdge * std::sqrt(3.0) / 4.0, 1e-9);
    }
}

TEST(CrystalSites, BondsLeadAcrossTheFacesToImages) {
    const Crystal crystal = zincBlende();
    const auto found = crystalSites(crystal, gridOver(crystal.lattice), {}, BondReach::Across);
    std::vector<int> bonds(found.sites.size());
    for (const CrystalBond& bond : found.bonds) {
        ++bonds[bond.first];
        ++bonds[bond.second];
    }
    for (std::size_t i = 0; i < found.sites.size(); ++i) {
        if (found.sites[i].inBox) {
            EXPECT_EQ(bonds[i], 4) << i;
        } else {
            EXPECT_EQ(found.sites[i].atomicNumber, kTe) << "all neighbours of Te in the box lie in the box";
            EXPECT_GE(bonds[i], 1) << "else it would be a stray";
        }
    }
    EXPECT_EQ(found.bonds.size(), 56U) << "four of each of 14 Cd";
    EXPECT_EQ(countOf(found, kCd), 14U);
    EXPECT_EQ(crystalSites(crystal, gridOver(crystal.lattice), {}, BondReach::None).bonds.size(), 0U);
}

TEST(CrystalSites, MoveWithTheShiftAndRepeatWithThePeriods) {
    const glm::dmat3 lattice(glm::dvec3(6.0, 0.5, 0.0), glm::dvec3(1.0, 7.0, -0.5),
                             glm::dvec3(0.0, 1.5, 6.5));
    const Crystal crystal = zincBlende(lattice);
    const Grid grid = gridOver(lattice);
    const PeriodicWindow window{{0.3, -0.2, 0.45}, {2, 1, 3}};
    const auto found = crystalSites(crystal, grid, window, BondReach::None);
    EXPECT_EQ(found.sites.size(), 6 * crystal.atoms.size()) << "none lies in a face";
    for (const glm::dvec3& corner : kFcc) {
        const auto in = glm::fract(corner + window.shift);
        for (int z = 0; z < 3; ++z)
            for (int x = 0; x < 2; ++x)
                EXPECT_TRUE(has(found, lattice * (in + glm::dvec3(x, 0, z))));
    }
    const auto half = crystalSites(zincBlende(), gridOver(glm::dmat3(kEdge)),
                                   {glm::dvec3(0.5), glm::ivec3(1)}, BondReach::None);
    EXPECT_EQ(countOf(half, kCd), 13U) << "12 edges and the centre";
}

TEST(CrystalSites, APrimitiveLatticeFillsTheBoxOfTheGrid) {
    const glm::dmat3 primitive =
        kEdge * glm::dmat3(glm::dvec3(0.0, 0.5, 0.5), glm::dvec3(0.5, 0.0, 0.5), glm::dvec3(0.5, 0.5, 0.0));
    Crystal crystal;
    crystal.lattice = primitive;
    crystal.atoms = {{kCd, glm::dvec3(0.0)}, {kTe, glm::dvec3(kEdge / 4.0)}};
    const Grid grid = gridOver(glm::dmat3(kEdge));
    const auto found = crystalSites(crystal, grid, {}, BondReach::Across);
    const auto cubic = crystalSites(zincBlende(), grid, {}, BondReach::Across);
    EXPECT_EQ(found.sites.size(), cubic.sites.size());
    EXPECT_EQ(found.bonds.size(), cubic.bonds.size());
    for (const CrystalSite& site : cubic.sites)
        EXPECT_TRUE(has(found, site.positionWorld));
    EXPECT_EQ(cellEdges(crystal, grid, {}).size(), 12U);
    EXPECT_EQ(cellEdges(crystal, grid, {{}, {2, 2, 2}}).size(), 12U) << "one cell";
}

TEST(CrystalSites, NothingRepeatsAlongAxesThatDoNotWrap) {
    const Crystal crystal = zincBlende();
    EXPECT_EQ(crystalSites(crystal, gridOver(crystal.lattice, glm::bvec3(false)), {}, BondReach::Across)
                  .sites.size(),
              8U);
    Crystal far = crystal;
    far.atoms.push_back({8, glm::dvec3(1.0, 1.0, 40.0)});
    const auto slab =
        crystalSites(far, gridOver(far.lattice, glm::bvec3(true, true, false)), {}, BondReach::None);
    EXPECT_TRUE(has(slab, glm::dvec3(1.0, 1.0, 40.0))) << "where the file has it";
    EXPECT_TRUE(has(slab, glm::dvec3(kEdge, kEdge, 0.0)));
    EXPECT_FALSE(has(slab, glm::dvec3(0.0, 0.0, kEdge)));
}

TEST(CrystalSites, MetalsAreBondedWhereThereIsNothingElse) {
    Crystal crystal;
    crystal.lattice = glm::dmat3(20.0);
    crystal.atoms = {{11, glm::dvec3(5.0)}, {12, glm::dvec3(5.0, 5.0, 8.2)}};
    const Grid grid = gridOver(crystal.lattice);
    EXPECT_EQ(crystalSites(crystal, grid, {}, BondReach::InBox).bonds.size(), 1U);
    crystal.atoms.push_back({9, glm::dvec3(5.0, 5.0, 6.5)});
    EXPECT_EQ(crystalSites(crystal, grid, {}, BondReach::InBox).bonds.size(), 2U) << "both to F";
    crystal.atoms.push_back({9, glm::dvec3(5.0, 5.0, 6.8)});
    EXPECT_EQ(crystalSites(crystal, grid, {}, BondReach::InBox).bonds.size(), 4U)
        << "too near: one atom twice";
}

TEST(CrystalSites, TooManyAreRefused) {
    Crystal crystal;
    crystal.lattice = glm::dmat3(10.0);
    crystal.atoms.assign(1000, {6, glm::dvec3(5.0)});
    try {
        (void)crystalSites(crystal, gridOver(crystal.lattice), {{}, glm::ivec3(8)}, BondReach::None);
        FAIL() << "512 000 of them";
    } catch (const LimitExceeded& error) {
        EXPECT_EQ(error.field(), "periodic.replicate");
    }
}

TEST(CrystalCells, HaveEveryEdgeOnce) {
    const glm::dmat3 lattice(glm::dvec3(6.0, 0.5, 0.0), glm::dvec3(1.0, 7.0, -0.5),
                             glm::dvec3(0.0, 1.5, 6.5));
    const Crystal crystal = zincBlende(lattice);
    const Grid grid = gridOver(lattice);
    EXPECT_EQ(cellEdges(crystal, grid, {}).size(), 12U);
    const auto edges = cellEdges(crystal, grid, {glm::dvec3(0.4), {2, 3, 1}});
    EXPECT_EQ(edges.size(), 2U * 4 * 2 + 3U * 3 * 2 + 1U * 3 * 4);
    std::set<std::string> distinct;
    for (const Segment& edge : edges) {
        const auto from = glm::inverse(lattice) * edge.start;
        const auto to = glm::inverse(lattice) * edge.end;
        EXPECT_LT(glm::distance(from, glm::round(from)), 1e-12) << "the shift moves no cell";
        EXPECT_NEAR(glm::distance(from, to), 1.0, 1e-12);
        const auto middle = glm::ivec3(glm::round(from + to));
        distinct.insert(std::to_string(middle.x) + "," + std::to_string(middle.y) + "," +
                        std::to_string(middle.z));
    }
    EXPECT_EQ(distinct.size(), edges.size());
}

TEST(CrystalCells, OutlinesLieInThePlaneAndInTheFaces) {
    const glm::dmat3 lattice(glm::dvec3(6.0, 0.5, 0.0), glm::dvec3(1.0, 7.0, -0.5),
                             glm::dvec3(0.0, 1.5, 6.5));
    const Crystal crystal = zincBlende(lattice);
    const Grid grid = gridOver(lattice);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, 0.2, 1.0));
    const double offset = glm::dot(normal, lattice * glm::dvec3(0.5));
    EXPECT_EQ(cellOutlines(crystal, grid, {}, normal, offset).size(), 4U);
    const auto outlines = cellOutlines(crystal, grid, {{}, {3, 2, 1}}, normal,
                                       glm::dot(normal, lattice * glm::dvec3(1.5, 1.0, 0.5)));
    EXPECT_GE(outlines.size(), 7U);
    for (const Segment& each : outlines) {
        for (const glm::dvec3& end : {each.start, each.end})
            EXPECT_NEAR(glm::dot(normal, end), glm::dot(normal, outlines.front().start), 1e-9);
        const auto middle = glm::inverse(lattice) * (0.5 * (each.start + each.end));
        const auto away = glm::abs(middle - glm::round(middle));
        EXPECT_LT(std::min({away.x, away.y, away.z}), 1e-9) << "in a face of a cell";
    }
    EXPECT_TRUE(cellOutlines(crystal, grid, {}, normal, 1e3).empty());
}

} // namespace
} // namespace voxsheet
