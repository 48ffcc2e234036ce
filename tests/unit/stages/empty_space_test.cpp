#include "stages/empty_space.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

TEST(EmptySpace, MarksAreKeptInProportionToTheTextureBudget) {
    EXPECT_EQ(markBytesFor(0), 16 * kMiB);
    EXPECT_EQ(markBytesFor(16 * kMiB), 16 * kMiB);
    EXPECT_EQ(markBytesFor(256 * kMiB), 32 * kMiB);
    EXPECT_EQ(markBytesFor(1024 * kMiB), 96 * kMiB);
    EXPECT_EQ(markBytesFor(std::uint64_t{1} << 40), 96 * kMiB);
}

} // namespace
} // namespace voxsheet
