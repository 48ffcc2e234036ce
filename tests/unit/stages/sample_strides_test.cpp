#include "stages/sample_strides.h"

#include "stages/classification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace voxsheet {
namespace {

constexpr StrideSettings kHalfVoxels{0.5, 1.0, false};

std::shared_ptr<const TransferTable> tableOf(std::vector<OpacityPoint> opacities) {
    TransferFunction function;
    function.colours = {{0.0, glm::dvec3(0.8)}, {1.0, glm::dvec3(0.8)}};
    function.opacities = std::move(opacities);
    return buildTransferTable(function);
}

MinMaxGrid gridOf(std::vector<MinMaxGrid::Range> ranges) {
    MinMaxGrid grid;
    grid.bricks = {static_cast<int>(ranges.size()), 1, 1};
    grid.ranges = std::move(ranges);
    return grid;
}

int exponentOf(const MinMaxGrid::Range& range, const TransferTable& table,
               const StrideSettings& settings = kHalfVoxels) {
    return strideExponents(gridOf({range}), table, settings).at(0);
}

TEST(SampleStrides, AreLongWhereTheTableDoesNotChange) {
    const auto flat = tableOf({{0.0, 0.3}, {1.0, 0.3}});
    EXPECT_EQ(exponentOf({0.0F, 1.0F}, *flat), 3); // eight times half a voxel
    EXPECT_EQ(exponentOf({0.0F, 1.0F}, *flat, {0.25, 1.0, false}), 4);
    EXPECT_EQ(exponentOf({0.0F, 1.0F}, *flat, {4.0, 1.0, false}), 0);
    EXPECT_EQ(exponentOf({INFINITY, -INFINITY}, *flat), 3) << "a brick of absent samples";
    EXPECT_EQ(exponentOf({NAN, 1.0F}, *flat), 0);
}

TEST(SampleStrides, AreShortWhereItHasAStep) {
    const auto step = tableOf({{0.0, 0.1}, {0.5, 0.1}, {0.5, 0.4}, {1.0, 0.4}});
    EXPECT_EQ(exponentOf({0.4F, 0.6F}, *step), 0);
    EXPECT_EQ(exponentOf({0.1F, 0.2F}, *step), 3);
    EXPECT_EQ(exponentOf({0.8F, 0.9F}, *step), 3);
    const auto peak = tableOf({{0.0, 0.0}, {0.495, 0.0}, {0.5, 0.5}, {0.505, 0.0}, {1.0, 0.0}});
    EXPECT_EQ(exponentOf({0.3F, 0.7F}, *peak), 0);
    EXPECT_EQ(exponentOf({0.6F, 0.7F}, *peak), 3);
}

TEST(SampleStrides, MatterOfColourCounts) {
    TransferFunction function;
    function.colours = {
        {0.0, {1.0, 0.0, 0.0}}, {0.5, {1.0, 0.0, 0.0}}, {0.5, {0.0, 0.0, 1.0}}, {1.0, {0.0, 0.0, 1.0}}};
    function.opacities = {{0.0, 0.3}, {1.0, 0.3}};
    EXPECT_EQ(exponentOf({0.4F, 0.6F}, *buildTransferTable(function)), 0);
}

TEST(SampleStrides, GrowNoLongerWithMatterOrLight) {
    const auto ramp = tableOf({{0.0, 0.0}, {1.0, 0.05}});
    int before = 4;
    for (const double units : {0.01, 0.1, 1.0, 10.0}) {
        const int exponent = exponentOf({0.2F, 0.5F}, *ramp, {0.5, units, false});
        EXPECT_LE(exponent, before);
        EXPECT_LE(exponentOf({0.2F, 0.5F}, *ramp, {0.5, units, true}), exponent);
        before = exponent;
    }
    EXPECT_EQ(before, 0);
}

/// Values that rise evenly over a brick and the samples beside it, which its range is of.
TEST(SampleStrides, KeepTheErrorOfRampsSmall) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    int longer = 0;
    for (int trial = 0; trial < 600; ++trial) {
        auto settings = kHalfVoxels;
        settings.brickSamples = trial % 2 == 0 ? 4 : 2;
        const double brickVoxels = settings.brickSamples + 1.0;
        std::vector<OpacityPoint> points{{0.0, 0.05 * number(random)}};
        for (int i = 1; i < 6; ++i)
            points.push_back({0.2 * i, 0.05 * number(random)});
        const auto table = tableOf(points);
        const double low = 0.7 * number(random), rise = 0.3 * number(random);
        const int exponent =
            exponentOf({static_cast<float>(low), static_cast<float>(low + rise)}, *table, settings);
        if (exponent == 0) continue;
        ++longer;
        const double voxels = 0.5 * (1 << exponent);
        const auto extinction = [&](double voxel) {
            return -std::log1p(-classify(*table, low + rise * voxel / brickVoxels).w);
        };
        for (double begin = 0.0; begin + voxels <= brickVoxels; begin += 0.25) {
            constexpr int count = 64;
            double mean = 0.0;
            for (int i = 0; i < count; ++i)
                mean += extinction(begin + voxels * (i + 0.5) / count) / count;
            EXPECT_LE(voxels * std::abs(mean - extinction(begin + 0.5 * voxels)), kLargestStrideError);
        }
    }
    EXPECT_GT(longer, 200);
}

} // namespace
} // namespace voxsheet
