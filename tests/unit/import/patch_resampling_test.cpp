// Patches of different cells onto one grid, against values worked out by hand.
#include "import/formats/patch_resampling.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>

namespace voxsheet::import {
namespace {

CellPatch patch(int level, const glm::dvec3& low, double cell, const glm::ivec3& dims) {
    return {level, low, glm::dvec3(cell), dims, glm::bvec3(false)};
}

template <typename T>
std::vector<T> painted(const PatchResampling& resampling, const std::vector<std::vector<T>>& values,
                       ScalarType type) {
    auto cells = resampling.blank(type);
    for (std::size_t i = 0; i < values.size(); ++i)
        resampling.paint(i, std::as_bytes(std::span(values[i])), type, cells);
    std::vector<T> result(cells.size() / sizeof(T));
    std::memcpy(result.data(), cells.data(), cells.size());
    return result;
}

template <typename T>
std::vector<T> counted(std::size_t count, T first) {
    std::vector<T> values(count);
    std::iota(values.begin(), values.end(), first);
    return values;
}

TEST(PatchResampling, TheFinestPatchCountsAndIntegersStay) {
    // Four cells of 2, and the third of them split into two (by two by two) cells of 1.
    const PatchResampling resampling(
        "x", {patch(0, {-4, 0, 0}, 2.0, {4, 1, 1}), patch(1, {0, 0, 0}, 1.0, {2, 2, 2})});
    EXPECT_EQ(resampling.grid().dims, glm::ivec3(8, 2, 2));
    EXPECT_EQ(resampling.grid().centring, Centring::Cell);
    EXPECT_EQ(glm::dvec3(resampling.grid().worldFromIndex[3]), glm::dvec3(-3.5, 0.5, 0.5));
    EXPECT_EQ(spacingWorld(resampling.grid()), glm::dvec3(1.0));
    EXPECT_EQ(resampling.resultType(ScalarType::I32), ScalarType::I32);
    const auto cells = painted<int>(resampling, {{10, 20, 30, 40}, counted(8, 1)}, ScalarType::I32);
    EXPECT_EQ(cells, (std::vector<int>{10, 10, 20, 20, 1, 2, 40, 40, 10, 10, 20, 20, 3, 4, 40, 40,
                                       10, 10, 20, 20, 5, 6, 40, 40, 10, 10, 20, 20, 7, 8, 40, 40}));
    EXPECT_NE(resampling.note().find("2 patches in 2 levels became a uniform grid of 8 x 2 x 2 cells"),
              std::string::npos)
        << resampling.note();
}

TEST(PatchResampling, PlacesWithoutAPatchHaveNoValue) {
    const PatchResampling resampling(
        "x", {patch(0, {0, 0, 0}, 1.0, {2, 1, 1}), patch(0, {3, 0, 0}, 1.0, {1, 1, 1})});
    EXPECT_EQ(resampling.resultType(ScalarType::U8), ScalarType::F32);
    EXPECT_EQ(resampling.resultType(ScalarType::I32), ScalarType::F64);
    EXPECT_NE(resampling.note().find("without a patch"), std::string::npos);
    auto cells = resampling.blank(ScalarType::U8);
    const std::vector<unsigned char> first{7, 8};
    const std::vector<unsigned char> second{9};
    resampling.paint(0, std::as_bytes(std::span(first)), ScalarType::U8, cells);
    resampling.paint(1, std::as_bytes(std::span(second)), ScalarType::U8, cells);
    std::vector<float> values(4);
    std::memcpy(values.data(), cells.data(), cells.size());
    EXPECT_EQ(values[0], 7.0F);
    EXPECT_EQ(values[1], 8.0F);
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_EQ(values[3], 9.0F);
}

TEST(PatchResampling, TooFineLevelsAreAveraged) {
    // Two cells; the second one split 512 x 512 x 512 times is 2^28 cells over both.
    const PatchResampling resampling("x", {patch(0, {0, 0, 0}, 512.0, {2, 1, 1}),
                                           patch(1, {512, 0, 0}, 128.0, {4, 4, 4}),
                                           patch(2, {512, 0, 0}, 1.0, {4, 2, 1})});
    EXPECT_EQ(resampling.grid().dims, glm::ivec3(8, 4, 4)) << "not 1024 x 512 x 512";
    EXPECT_EQ(resampling.resultType(ScalarType::U8), ScalarType::F32);
    EXPECT_NE(resampling.note().find("of level 1; smaller ones were averaged"), std::string::npos);
    const auto cells =
        painted<double>(resampling, {{1, 2}, counted(64, 100.0), counted(8, 0.0)}, ScalarType::F64);
    EXPECT_EQ(cells[3], 1.0);
    EXPECT_EQ(cells[4], 3.5) << "the mean of 0 to 7";
    EXPECT_EQ(cells[5], 101.0);
    EXPECT_EQ(cells[127], 163.0);
}

TEST(PatchResampling, FlatPatchesStayFlat) {
    auto coarse = patch(0, {0, 0, 5}, 2.0, {2, 2, 1});
    auto fine = patch(1, {2, 2, 5.5}, 1.0, {2, 2, 1});
    coarse.flat.z = fine.flat.z = true;
    const PatchResampling resampling("x", {coarse, fine});
    EXPECT_EQ(resampling.grid().dims, glm::ivec3(4, 4, 1));
    EXPECT_EQ(resampling.resultType(ScalarType::U8), ScalarType::U8);
    const auto cells = painted<short>(resampling, {{1, 2, 3, 4}, {5, 6, 7, 8}}, ScalarType::I16);
    EXPECT_EQ(cells, (std::vector<short>{1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 5, 6, 3, 3, 7, 8}));
}

TEST(PatchResampling, WhatCannotBeIsRefused) {
    EXPECT_THROW(
        PatchResampling("x", {patch(0, {0, 0, 0}, 1.0, {2, 2, 2}), patch(0, {2, 0, 0}, 1.5, {2, 2, 2})}),
        InvalidInput);
    EXPECT_THROW(
        PatchResampling("x", {patch(0, {0, 0, 0}, 1.0, {2, 2, 2}), patch(0, {1e6, 1e6, 0}, 1.0, {2, 2, 2})}),
        LimitExceeded)
        << "two small patches far apart";
    EXPECT_THROW(
        PatchResampling("x", {patch(0, {0, 0, 0}, 1.0, {2, 2, 2}), patch(0, {1e300, 0, 0}, 1.0, {2, 2, 2})}),
        LimitExceeded);
}

} // namespace
} // namespace voxsheet::import
