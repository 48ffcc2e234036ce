#include "bench/time_n/n_steps.h"

#include <gtest/gtest.h>

#include <vector>

namespace voxsheet::bench {
namespace {

std::vector<int> measured(int step, int last) {
    std::vector<int> all;
    for (int n = 1; n <= last; n = nextN(n, step, last))
        all.push_back(n);
    return all;
}

TEST(NSteps, AreDenseAtSmallNOnly) {
    EXPECT_EQ(measured(1, 6), (std::vector<int>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(measured(2, 7), (std::vector<int>{1, 2, 4, 6, 7}));
    EXPECT_EQ(measured(4, 16), (std::vector<int>{1, 2, 3, 4, 8, 12, 16}));
    EXPECT_EQ(measured(12, 30), (std::vector<int>{1, 2, 3, 4, 8, 12, 24, 30}));
    EXPECT_EQ(measured(32, 128), (std::vector<int>{1, 2, 3, 4, 8, 16, 32, 64, 96, 128}));
    EXPECT_EQ(measured(32, 10), (std::vector<int>{1, 2, 3, 4, 8, 10}));
}

} // namespace
} // namespace voxsheet::bench
