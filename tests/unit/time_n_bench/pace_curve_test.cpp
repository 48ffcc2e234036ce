#include "bench/time_n/pace_curve.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet::bench {
namespace {

using namespace std::chrono_literals;

const PaceCurve::Clock::time_point kStart{};

TEST(PaceCurve, FollowsAMachineThatIsSlowerForAWhile) {
    PaceCurve curve;
    for (int i = 0; i < 60; ++i)
        curve.add(kStart + i * 30ms, i >= 20 && i < 40 ? 13.0 : 10.0);
    EXPECT_EQ(curve.msAt(kStart), 10.0);
    EXPECT_EQ(curve.msAt(kStart + 500ms), 10.0);
    EXPECT_EQ(curve.msAt(kStart + 700ms), 13.0);
    EXPECT_EQ(curve.msAt(kStart + 1100ms), 13.0);
    EXPECT_EQ(curve.msAt(kStart + 1300ms), 10.0);
    EXPECT_EQ(curve.msAt(kStart + 1h), 10.0);
}

TEST(PaceCurve, SingleLooksThatWereHeldUpCountForNothing) {
    PaceCurve curve;
    for (int i = 0; i < 30; ++i)
        curve.add(kStart + i * 30ms, i % 3 == 0 ? 50.0 : 10.0);
    for (int ms = 0; ms < 900; ms += 10)
        EXPECT_EQ(curve.msAt(kStart + ms * 1ms), 10.0) << ms;
}

TEST(PaceCurve, FewLooksAreBetterThanNone) {
    PaceCurve curve;
    EXPECT_THROW((void)curve.msAt(kStart), InternalError);
    EXPECT_TRUE(curve.isDue(kStart, 30ms));
    curve.add(kStart, 8.0);
    EXPECT_EQ(curve.msAt(kStart + 5s), 8.0);
    EXPECT_FALSE(curve.isDue(kStart + 29ms, 30ms));
    EXPECT_TRUE(curve.isDue(kStart + 30ms, 30ms));
}

} // namespace
} // namespace voxsheet::bench
