#include "frame/band_pace.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

TEST(BandPace, SmallPicturesAreWhole) {
    const BandPace pace;
    EXPECT_EQ(pace.rows({256, 256}, 300.0), 256);
    const int rows = pace.rows({1280, 800}, 900.0);
    EXPECT_EQ(rows % 8, 0);
    EXPECT_GE(rows, 8);
    EXPECT_LT(rows, 400);
    EXPECT_EQ(pace.rows({8192, 8192}, 1e9), 8);
}

TEST(BandPace, FollowsTheDevice) {
    BandPace fast;
    const glm::ivec2 size(1280, 800);
    const int before = fast.rows(size, 900.0);
    fast.observe(before, size.x, 900.0, 0.1);
    EXPECT_LE(fast.rows(size, 900.0), 2 * before + 8); // the rows were perhaps empty
    EXPECT_GT(fast.rows(size, 900.0), before);
    for (int band = 0; band < 10; ++band)
        fast.observe(fast.rows(size, 900.0), size.x, 900.0, 0.1);
    EXPECT_EQ(fast.rows(size, 900.0), size.y);
    BandPace slow;
    slow.observe(64, size.x, 900.0, 64.0 / before * 8.0 * BandPace::bandMs);
    EXPECT_LE(slow.rows(size, 900.0), before / 8 + 8);
}

} // namespace
} // namespace voxsheet
