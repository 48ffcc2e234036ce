#include "volume/periodic_window.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace voxsheet {
namespace {

constexpr double kRounding = 1e-12; ///< of matrix products in double precision, for numbers about 10

Grid crystal() {
    Grid grid;
    grid.dims = {10, 20, 8};
    grid.worldFromIndex[0] = {0.5, 0.1, 0.0, 0.0};
    grid.worldFromIndex[1] = {0.2, 0.4, 0.0, 0.0};
    grid.worldFromIndex[2] = {0.0, 0.1, 0.6, 0.0};
    grid.worldFromIndex[3] = {3.0, -1.0, 2.0, 1.0};
    grid.periodic = glm::bvec3(true, true, false);
    return grid;
}

std::string fieldOf(const PeriodicWindow& window, const Grid& grid) {
    try {
        validatePeriodicWindow(window, grid);
    } catch (const InvalidInput& error) {
        return error.field();
    }
    return "";
}

TEST(PeriodicWindow, TheDefaultChangesNoGrid) {
    EXPECT_EQ(drawnGrid(crystal(), {}), crystal());
    EXPECT_EQ(placedGrid(crystal(), {}), crystal());
}

TEST(PeriodicWindow, TheBoxGrowsFromItsOriginAndIgnoresTheShift) {
    const auto drawn = drawnGrid(crystal(), {{0.3, 0.2, 0.0}, {2, 3, 1}});
    EXPECT_EQ(drawn.worldFromIndex, crystal().worldFromIndex);
    EXPECT_EQ(boxIndex(drawn).low, boxIndex(crystal()).low);
    EXPECT_EQ(boxIndex(drawn).high, glm::dvec3(20.0, 60.0, 7.0));
}

TEST(PeriodicWindow, WhatLayAtAFractionLiesAtItPlusTheShift) {
    const PeriodicWindow window{{0.25, -0.4, 0.0}, glm::ivec3(1)};
    const auto placed = placedGrid(crystal(), window);
    const glm::dvec3 sample(3.0, 4.0, 5.0);
    const auto moved = glm::dvec3(placed.worldFromIndex * glm::dvec4(sample, 1.0));
    const auto expected =
        glm::dvec3(crystal().worldFromIndex * glm::dvec4(sample + glm::dvec3(2.5, 0.6 * 20.0, 0.0), 1.0));
    EXPECT_LT(glm::distance(moved, expected), kRounding) << "-0.4 is 0.6, one period further";
}

TEST(PeriodicWindow, ErrorsNameTheKey) {
    EXPECT_EQ(fieldOf({{0.3, -0.7, 0.0}, {2, 8, 1}}, crystal()), "");
    EXPECT_EQ(fieldOf({{0.0, 0.0, 0.5}, glm::ivec3(1)}, crystal()), "periodic.shift");
    EXPECT_EQ(fieldOf({glm::dvec3(0.0), {1, 1, 2}}, crystal()), "periodic.replicate");
    EXPECT_EQ(fieldOf({glm::dvec3(0.0), {9, 1, 1}}, crystal()), "periodic.replicate");
    EXPECT_EQ(fieldOf({glm::dvec3(0.0), {1, 0, 1}}, crystal()), "periodic.replicate");
    EXPECT_EQ(fieldOf({{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, glm::ivec3(1)}, crystal()),
              "periodic.shift");
    Grid plain = crystal();
    plain.periodic = glm::bvec3(false);
    EXPECT_EQ(fieldOf({{0.5, 0.0, 0.0}, glm::ivec3(1)}, plain), "periodic.shift");
    EXPECT_EQ(fieldOf({}, plain), "");
}

} // namespace
} // namespace voxsheet
