#include "stream/absent_tiles.h"

#include <gtest/gtest.h>

namespace voxsheet::stream {
namespace {

FramePlan planOf(int tiles) {
    FramePlan plan;
    for (int i = 0; i < tiles; ++i) {
        plan.tiles.emplace_back();
        plan.tiles.back().tile.cell = {i, 0};
    }
    return plan;
}

FrameResult drawnOf(const std::vector<bool>& absent) {
    FrameResult frame;
    for (std::size_t i = 0; i < absent.size(); ++i) {
        frame.tiles.emplace_back();
        frame.tiles.back().absent = absent[i];
        frame.tiles.back().level = static_cast<int>(i);
    }
    return frame;
}

TEST(AbsentTiles, LeaveThePlanAndTheOthersKeepTheirPictures) {
    FramePlan plan = planOf(5);
    std::vector<std::size_t> drawnBy{0, 2, 3, 4}; // tile 1 was at hand
    FrameResult frame = drawnOf({true, false, true, false});
    leaveOutAbsent(plan, drawnBy, frame);
    std::vector<int> columns;
    for (const auto& tile : plan.tiles)
        columns.push_back(tile.tile.cell.column);
    EXPECT_EQ(columns, (std::vector<int>{1, 2, 4}));
    EXPECT_EQ(drawnBy, (std::vector<std::size_t>{1, 2}));
    ASSERT_EQ(frame.tiles.size(), 2U);
    EXPECT_EQ(frame.tiles[0].level, 1);
    EXPECT_EQ(frame.tiles[1].level, 3);
}

TEST(AbsentTiles, AFrameOfNothingElseLeavesNothingToSend) {
    FramePlan plan = planOf(2);
    std::vector<std::size_t> drawnBy{0, 1};
    FrameResult frame = drawnOf({true, true});
    leaveOutAbsent(plan, drawnBy, frame);
    EXPECT_TRUE(plan.empty());
    EXPECT_TRUE(drawnBy.empty());
    EXPECT_TRUE(frame.tiles.empty());
}

TEST(AbsentTiles, WithoutAnyNothingChanges) {
    FramePlan plan = planOf(2);
    std::vector<std::size_t> drawnBy{1};
    FrameResult frame = drawnOf({false});
    leaveOutAbsent(plan, drawnBy, frame);
    EXPECT_EQ(plan.tiles.size(), 2U);
    EXPECT_EQ(drawnBy, (std::vector<std::size_t>{1}));
    EXPECT_EQ(frame.tiles.size(), 1U);
}

} // namespace
} // namespace voxsheet::stream
