#include "frame/timer_check.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

FrameResult frameOf(int tiles, double timestampMs, double hostMs) {
    TilePixels tile;
    tile.timestampMs = timestampMs;
    tile.hostMs = hostMs;
    FrameResult frame;
    frame.tiles.assign(static_cast<std::size_t>(tiles), tile);
    return frame;
}

bool agrees(int tiles, double timestampMs, double hostMs) {
    TimerCheck check;
    check.add(frameOf(tiles, timestampMs, hostMs));
    return check.agrees();
}

TEST(TimerCheck, ATenthMayBeMissing) {
    EXPECT_TRUE(agrees(4, 100.0, 100.0));
    EXPECT_TRUE(agrees(4, 90.0, 100.0));
    EXPECT_FALSE(agrees(4, 88.0, 100.0));
    EXPECT_FALSE(agrees(4, 112.0, 100.0));
}

TEST(TimerCheck, ABrokenTimerDoesNotAgree) {
    EXPECT_FALSE(agrees(4, 0.0, 5.0));
    EXPECT_FALSE(agrees(1, 5000.0, 5.0));
}

TEST(TimerCheck, TinyTilesHaveAMillisecondEach) {
    EXPECT_TRUE(agrees(16, 0.2, 1.1));
    EXPECT_FALSE(agrees(16, 0.2, 1.6));
}

TEST(TimerCheck, FailedTilesDoNotCount) {
    auto frame = frameOf(2, 50.0, 50.0);
    frame.tiles[1].timestampMs = 0.0;
    TimerCheck check;
    frame.tiles[1].error = "no memory";
    check.add(frame);
    EXPECT_EQ(check.tiles(), 1);
    EXPECT_TRUE(check.agrees());
}

} // namespace
} // namespace voxsheet
