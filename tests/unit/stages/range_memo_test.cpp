#include "stages/range_memo.h"

#include <gtest/gtest.h>

#include <random>

namespace voxsheet {
namespace {

TEST(RangeMemo, AsksOnceAndGivesWhatItWasToldOfThatRange) {
    RangeMemo<float> memo;
    int asked = 0;
    const auto width = [&](const MinMaxGrid::Range& range) {
        ++asked;
        return range.high - range.low;
    };
    EXPECT_EQ(memo({0.0F, 0.0F}, width), 0.0F) << "a range whose bits are all 0 was not asked for before";
    EXPECT_EQ(asked, 1);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(memo({1.0F, 3.0F}, width), 2.0F);
    EXPECT_EQ(asked, 2);
    // Many more than it has room for.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(-1.0F, 1.0F);
    for (int i = 0; i < 20000; ++i) {
        const MinMaxGrid::Range range{value(random), value(random)};
        EXPECT_EQ(memo(range, width), range.high - range.low);
    }
}

} // namespace
} // namespace voxsheet
