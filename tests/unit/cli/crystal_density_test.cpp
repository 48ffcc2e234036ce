#include "cli/demo/crystal_density.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace voxsheet::cli {
namespace {

double volume(const Supercell& cell) { return cell.lengths.x * cell.lengths.y * cell.lengths.z; }

int count(const Supercell& cell, Element element) {
    int n = 0;
    for (const auto& site : cell.sites)
        if (site.element == element) ++n;
    return n;
}

double distance(const Supercell& cell, const Site& a, const Site& b) {
    auto d = b.fractional - a.fractional;
    d -= glm::round(d);
    return glm::length(d * cell.lengths);
}

TEST(CrystalDensity, PerovskiteHasSixtySites) {
    const auto cell = perovskite60();
    EXPECT_EQ(count(cell, Element::Mg), 12);
    EXPECT_EQ(count(cell, Element::Si), 12);
    EXPECT_EQ(count(cell, Element::O), 36);
}

TEST(CrystalDensity, EverySiliconSitsInAnOxygenOctahedron) {
    // Horiuchi, Ito & Weidner 1987: mean Si-O distance 1.79 Å. A wrong symmetry operation breaks the
    // octahedra.
    const auto cell = perovskite60();
    for (const auto& si : cell.sites) {
        if (si.element != Element::Si) continue;
        int neighbours = 0;
        for (const auto& o : cell.sites) {
            if (o.element != Element::O) continue;
            const double d = distance(cell, si, o);
            if (d < 2.2) {
                ++neighbours;
                EXPECT_NEAR(d, 1.79, 0.03);
            }
        }
        EXPECT_EQ(neighbours, 6);
    }
}

TEST(CrystalDensity, AtomsHoldTheirElectrons) {
    // 4 pi integral of r^2 rho(r) dr = a_1 + … + a_4 + c, which the table gives to 0.02 electrons.
    for (const auto element : {Element::Mg, Element::Si, Element::O}) {
        double electrons = 0.0;
        const double step = 1e-3;
        for (double r = step / 2; r < 20.0; r += step)
            electrons += 4.0 * 3.14159265358979 * r * r * atomDensity(element, r * r) * step;
        EXPECT_NEAR(electrons, electronCount(element), 0.02);
    }
}

TEST(CrystalDensity, CellHoldsItsElectrons) {
    const auto cell = perovskite60();
    const glm::ivec3 dims{144, 50, 70};
    const auto density = electronDensity(cell, dims);
    const double mean =
        std::accumulate(density.begin(), density.end(), 0.0) / static_cast<double>(density.size());
    // 12 Mg + 12 Si + 36 O = 600; sampling the cores at 0.1 Å and the 6 Å cut-off cost less than 1.
    EXPECT_NEAR(mean * volume(cell), 600.0, 1.0);
}

TEST(CrystalDensity, VacancyTakesOneAtomAndMovesItsNeighbours) {
    const auto perfect = perovskite60();
    for (const auto element : {Element::Mg, Element::Si, Element::O}) {
        const auto defect = withVacancy(perfect, element);
        EXPECT_EQ(defect.sites.size(), 59U);
        EXPECT_EQ(count(defect, element), count(perfect, element) - 1);
        double largest = 0.0;
        for (const auto& site : defect.sites) {
            double nearest = 1e9;
            for (const auto& old : perfect.sites)
                if (old.element == site.element) nearest = std::min(nearest, distance(perfect, old, site));
            largest = std::max(largest, nearest);
        }
        EXPECT_GT(largest, 0.05);
        EXPECT_LT(largest, 0.2);
    }
}

} // namespace
} // namespace voxsheet::cli
