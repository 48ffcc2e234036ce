#include "bench/time_n/second_look.h"

#include <gtest/gtest.h>

namespace voxsheet::bench {
namespace {

TEST(SecondLook, BelievesWhatTwoPassesFindAtAboutTheSameN) {
    SecondLook look;
    EXPECT_TRUE(look.wantsAnother(28, 1));
    EXPECT_FALSE(look.wantsAnother(24, 1));
    SecondLook small;
    EXPECT_TRUE(small.wantsAnother(3, 1));
    EXPECT_FALSE(small.wantsAnother(5, 1));
    SecondLook sparse;
    EXPECT_TRUE(sparse.wantsAnother(64, 32));
    EXPECT_FALSE(sparse.wantsAnother(96, 32)) << "the next point";
}

TEST(SecondLook, DoubtsABendThatWandersAndGivesInAtLast) {
    SecondLook look;
    EXPECT_TRUE(look.wantsAnother(13, 1));
    EXPECT_TRUE(look.wantsAnother(28, 1)) << "13 was a while of a slow machine";
    EXPECT_TRUE(look.wantsAnother(60, 1));
    EXPECT_FALSE(look.wantsAnother(8, 1)) << "four passes";
}

TEST(SecondLook, ComparesWithThePassJustBefore) {
    SecondLook look;
    EXPECT_TRUE(look.wantsAnother(10, 1));
    EXPECT_TRUE(look.wantsAnother(40, 1));
    EXPECT_FALSE(look.wantsAnother(44, 1));
}

} // namespace
} // namespace voxsheet::bench
