#include "bench/time_n/second_look.h"

#include <gtest/gtest.h>

namespace voxsheet::bench {
namespace {

TEST(SecondLook, BelievesWhatTwoPassesFindAtAboutTheSameN) {
    SecondLook look;
    EXPECT_TRUE(look.wantsAnother(28));
    EXPECT_FALSE(look.wantsAnother(24));
    SecondLook small;
    EXPECT_TRUE(small.wantsAnother(3));
    EXPECT_FALSE(small.wantsAnother(5));
}

TEST(SecondLook, DoubtsABendThatWandersAndGivesInAtLast) {
    SecondLook look;
    EXPECT_TRUE(look.wantsAnother(13));
    EXPECT_TRUE(look.wantsAnother(28)) << "13 was a while of a slow machine";
    EXPECT_TRUE(look.wantsAnother(60));
    EXPECT_FALSE(look.wantsAnother(8)) << "four passes";
}

TEST(SecondLook, ComparesWithThePassJustBefore) {
    SecondLook look;
    EXPECT_TRUE(look.wantsAnother(10));
    EXPECT_TRUE(look.wantsAnother(40));
    EXPECT_FALSE(look.wantsAnother(44));
}

} // namespace
} // namespace voxsheet::bench
