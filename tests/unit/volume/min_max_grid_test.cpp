#include "volume/grid.h"
#include "volume/min_max_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace voxsheet {
namespace {

/// By the definition: the range over samples s b - 1 .. s b + s, clamped or wrapped.
MinMaxGrid::Range referenceRange(const std::vector<float>& samples, glm::ivec3 n, glm::bvec3 periodic,
                                 glm::ivec3 b) {
    MinMaxGrid::Range range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    const auto at = [&](int i, int axis) {
        if (periodic[axis]) return (i % n[axis] + n[axis]) % n[axis];
        return std::clamp(i, 0, n[axis] - 1);
    };
    const int s = MinMaxGrid::brickSamplesFor(n);
    for (int z = s * b.z - 1; z <= s * b.z + s; ++z)
        for (int y = s * b.y - 1; y <= s * b.y + s; ++y)
            for (int x = s * b.x - 1; x <= s * b.x + s; ++x) {
                const float v =
                    samples[static_cast<std::size_t>((at(z, 2) * n.y + at(y, 1)) * n.x + at(x, 0))];
                if (std::isnan(v)) continue;
                range.low = std::min(range.low, v);
                range.high = std::max(range.high, v);
            }
    return range;
}

TEST(MinMaxGrid, AgreesWithItsDefinition) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(-1.0F, 1.0F);
    for (const glm::ivec3 n : {glm::ivec3(16, 8, 24), glm::ivec3(17, 9, 1), glm::ivec3(3, 30, 12),
                               glm::ivec3(130, 123, 66)}) // the last with bricks of 4
        for (const glm::bvec3 periodic :
             {glm::bvec3(false), glm::bvec3(true), glm::bvec3(true, false, true)}) {
            std::vector<float> samples(static_cast<std::size_t>(sampleCount(n)));
            for (auto& s : samples)
                s = random() % 7 == 0 ? std::nanf("") : value(random);
            const auto grid =
                buildMinMaxGrid({ScalarType::F32, n, std::as_bytes(std::span(samples))}, periodic);
            ASSERT_EQ(grid.bricks, MinMaxGrid::bricksFor(n));
            for (int z = 0; z < grid.bricks.z; ++z)
                for (int y = 0; y < grid.bricks.y; ++y)
                    for (int x = 0; x < grid.bricks.x; ++x) {
                        const auto expected = referenceRange(samples, n, periodic, {x, y, z});
                        const auto& got = grid.ranges[static_cast<std::size_t>(
                            (z * grid.bricks.y + y) * grid.bricks.x + x)];
                        EXPECT_EQ(got.low, expected.low);
                        EXPECT_EQ(got.high, expected.high);
                    }
        }
}

TEST(MinMaxGrid, BricksGrowBeforeThereAreTooMany) {
    EXPECT_EQ(MinMaxGrid::brickSamplesFor({128, 128, 64}), 2);
    EXPECT_EQ(MinMaxGrid::brickSamplesFor({128, 128, 65}), 4);
    EXPECT_EQ(MinMaxGrid::brickSamplesFor({1024, 1024, 1024}), 4);
    EXPECT_EQ(MinMaxGrid::bricksFor({1024, 1024, 1024}), glm::ivec3(256));
    EXPECT_EQ(MinMaxGrid::brickSamplesFor({1025, 1024, 1024}), 8);
    EXPECT_EQ(MinMaxGrid::bricksFor({1025, 1024, 1024}), glm::ivec3(129, 128, 128));
    EXPECT_EQ(MinMaxGrid::brickSamplesFor({2048, 2048, 2048}), 8) << "no overflow";
}

TEST(MinMaxGrid, BrickOfNanOnlyIsEmpty) {
    const std::vector<double> samples(8, std::nan(""));
    const auto grid =
        buildMinMaxGrid({ScalarType::F64, {2, 2, 2}, std::as_bytes(std::span(samples))}, glm::bvec3(false));
    ASSERT_EQ(grid.ranges.size(), 1U);
    EXPECT_EQ(grid.ranges[0].low, std::numeric_limits<float>::infinity());
    EXPECT_EQ(grid.ranges[0].high, -std::numeric_limits<float>::infinity());
}

TEST(MinMaxGrid, RangesAreOfValuesAndNegativeSlopesSwapThem) {
    const std::vector<short> samples{-5, 10};
    const auto grid = buildMinMaxGrid(
        {ScalarType::I16, {2, 1, 1}, std::as_bytes(std::span(samples)), -2.0, 1.0}, glm::bvec3(false));
    EXPECT_EQ(grid.ranges[0].low, -19.0F);
    EXPECT_EQ(grid.ranges[0].high, 11.0F);
}

TEST(MinMaxGrid, RangesThatHaveNoFloatAreWidened) {
    const std::vector<double> samples{0.1, 16777217.0};
    const auto grid =
        buildMinMaxGrid({ScalarType::F64, {2, 1, 1}, std::as_bytes(std::span(samples))}, glm::bvec3(false));
    EXPECT_LE(double(grid.ranges[0].low), 0.1);
    EXPECT_GE(double(grid.ranges[0].high), 16777217.0);
    EXPECT_NEAR(double(grid.ranges[0].low), 0.1, 1e-7);
}

} // namespace
} // namespace voxsheet
