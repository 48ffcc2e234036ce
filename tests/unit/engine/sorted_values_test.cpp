#include "engine/sorted_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace voxsheet::engine {
namespace {

/// Every kind of float: random bits, of which some are NaN or infinite, small numbers of both signs, both
/// zeros.
std::vector<float> manyKinds(std::size_t count) {
    std::mt19937 random(5);
    std::normal_distribution<float> near(0.0F, 3.0F);
    std::vector<float> values{0.0F,
                              -0.0F,
                              std::numeric_limits<float>::max(),
                              std::numeric_limits<float>::lowest(),
                              std::numeric_limits<float>::denorm_min(),
                              -std::numeric_limits<float>::denorm_min(),
                              std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN()};
    while (values.size() < count)
        values.push_back(values.size() % 2 == 0 ? near(random)
                                                : std::bit_cast<float>(static_cast<std::uint32_t>(random())));
    return values;
}

TEST(SortedValues, FewAndManyAreAsComparingSortsThem) {
    for (const std::size_t count : {9U, 1000U, 50000U}) { // sorted by comparing, and by digits
        auto values = manyKinds(count);
        auto expected = values;
        std::erase_if(expected, [](float value) { return !std::isfinite(value); });
        std::sort(expected.begin(), expected.end());
        sortFinite(values);
        EXPECT_EQ(values, expected) << count;
        EXPECT_TRUE(std::none_of(values.begin(), values.end(), [](float value) {
            return value == 0.0F && std::signbit(value);
        })) << count;
    }
}

TEST(SortedValues, NothingFiniteLeavesNothing) {
    std::vector<float> values(5000, std::numeric_limits<float>::quiet_NaN());
    sortFinite(values);
    EXPECT_TRUE(values.empty());
}

} // namespace
} // namespace voxsheet::engine
