#include "stream/sheet_levels.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet::stream {
namespace {

constexpr std::uint64_t kAmpleBytes = std::uint64_t{1} << 40U;

/// Four cells of 128^3 in tiles of 256 x 256, each of another volume; the last one is looked at.
std::vector<CellOnShow> cells(double texelEdgePixels = 1.0) {
    std::vector<CellOnShow> all;
    for (int i = 0; i < 4; ++i) {
        CellOnShow cell;
        cell.cell = {i, 0};
        cell.work = "raycast";
        cell.demand.volume = "v" + std::to_string(i);
        cell.demand.texelEdgePixels = texelEdgePixels;
        cell.demand.pixels = kTimedTilePixels;
        cell.demand.textureBytes = {4U << 20U, 512U << 10U, 64U << 10U, 8U << 10U};
        cell.demand.focused = i == 3;
        all.push_back(std::move(cell));
    }
    return all;
}

void learn(SheetLevels& levels, double msAtLevelZero) {
    for (const CellOnShow& cell : cells())
        static_cast<void>(
            levels.drawn({cell.demand.volume, cell.work, 4, 0, kTimedTilePixels, msAtLevelZero, 0.0}));
}

std::vector<CellOnShow> at(std::vector<CellOnShow> all, const std::vector<int>& levels) {
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].previous = levels[i];
    return all;
}

class SheetLevelsTest : public testing::Test {
protected:
    SheetLevels levels{LevelSettings{}, [this] { ++changes; }};
    int changes = 0;
};

TEST_F(SheetLevelsTest, NothingIsLoweredBeforePicturesAreKnownToBeSlow) {
    EXPECT_EQ(levels.choose(cells(), kAmpleBytes, true, false), (std::vector<int>{0, 0, 0, 0}));
    learn(levels, 400.0); // 1600 ms of 1000
    const auto chosen = levels.choose(at(cells(), {0, 0, 0, 0}), kAmpleBytes, true, false);
    EXPECT_EQ(chosen[3], 0);
    EXPECT_GE(chosen[0], 1);
}

TEST_F(SheetLevelsTest, APictureAtRestIsNotDrawnAgainForWhatWasLearnedFromIt) {
    const auto first = levels.choose(cells(), kAmpleBytes, true, false);
    learn(levels, 400.0);
    EXPECT_EQ(levels.choose(at(cells(), first), kAmpleBytes, true, true), first);
}

TEST_F(SheetLevelsTest, ACoarserLevelThatOnceSeemedSlowerIsStillTried) {
    LevelSettings tight;
    tight.frameMs = 0.001;
    levels.setSettings(tight);
    learn(levels, 10.0);
    for (const CellOnShow& cell : cells())
        static_cast<void>(levels.drawn({cell.demand.volume, cell.work, 4, 1, kTimedTilePixels, 30.0, 0.0}));
    EXPECT_EQ(levels.choose(cells(), kAmpleBytes, true, false), (std::vector<int>{3, 3, 3, 3}));
}

TEST_F(SheetLevelsTest, TheTextureBudgetCountsToo) {
    const auto chosen = levels.choose(cells(), 9U << 20U, true, false);
    EXPECT_EQ(chosen[3], 0);
    EXPECT_EQ(chosen[0] + chosen[1] + chosen[2], 2); // 4 + 4 + 0.5 + 0.5 MiB
}

TEST_F(SheetLevelsTest, ARefusedSettingLeavesTheOldOnes) {
    LevelSettings bad = levels.settings();
    bad.policy = LevelPolicy::Time;
    bad.frameMs = -1.0;
    EXPECT_THROW(levels.setSettings(bad), InvalidInput);
    EXPECT_EQ(levels.settings(), LevelSettings{});
    EXPECT_EQ(changes, 0);
    bad.frameMs = 5.0;
    levels.setSettings(bad);
    EXPECT_EQ(changes, 1);
}

TEST_F(SheetLevelsTest, TheSlopeRuleSwitchesAllCellsOnceTheCurveBends) {
    LevelSettings slope;
    slope.policy = LevelPolicy::Slope;
    levels.setSettings(slope);
    changes = 0;
    std::vector<CellOnShow> shown;
    int switchedAt = 0;
    for (int n = 1; n <= 24 && switchedAt == 0; ++n) {
        auto next = cells().front();
        next.demand.volume = "n" + std::to_string(n);
        shown.push_back(next);
        const double ms = n <= 12 ? 10.0 * n : 120.0 + 20.0 * (n - 12); // doubles after 12
        for (int frame = 0; frame < 6; ++frame)
            levels.redrawn({n, ms * (1.0 + 0.002 * frame), 0, "raycast", 0});
        const auto chosen = levels.choose(shown, kAmpleBytes, true, false);
        if (chosen.front() == 1) switchedAt = n;
        EXPECT_EQ(chosen, std::vector<int>(shown.size(), chosen.front()));
    }
    EXPECT_GT(switchedAt, 12);
    EXPECT_LE(switchedAt, 16);
    EXPECT_EQ(changes, 1); // other pages are told
    const auto timings = levels.timings();
    EXPECT_EQ(static_cast<int>(timings.points.size()), switchedAt);
    EXPECT_NE(timings.reason.find("R = "), std::string::npos) << timings.reason;
}

TEST_F(SheetLevelsTest, WhileMovingTheRulesForAllCellsDoNotSwitch) {
    LevelSettings count;
    count.policy = LevelPolicy::Count;
    count.datasets = 2;
    levels.setSettings(count);
    EXPECT_EQ(levels.choose(cells(), kAmpleBytes, false, false), (std::vector<int>{0, 0, 0, 0}));
    EXPECT_EQ(levels.choose(cells(), kAmpleBytes, true, false), (std::vector<int>{1, 1, 1, 1}));
    EXPECT_EQ(levels.choose(cells(), kAmpleBytes, false, false), (std::vector<int>{1, 1, 1, 1}));
    // Back to a level per cell: full level again.
    levels.setSettings({});
    EXPECT_EQ(levels.choose(cells(), kAmpleBytes, true, false), (std::vector<int>{0, 0, 0, 0}));
}

TEST_F(SheetLevelsTest, TimesOfAnotherKindOfWorkAreForgotten) {
    levels.redrawn({1, 10.0, 0, "raycast", 0});
    levels.redrawn({2, 20.0, 0, "raycast", 0});
    EXPECT_EQ(levels.timings().points.size(), 2U);
    levels.redrawn({2, 50.0, 0, "isosurface", 0});
    ASSERT_EQ(levels.timings().points.size(), 1U);
    EXPECT_DOUBLE_EQ(levels.timings().points[0].ms.value, 50.0);
}

TEST_F(SheetLevelsTest, BringingAVolumeInTheFirstTimeIsNoPartOfTheTimeOfN) {
    DrawnPicture picture{"v", "raycast", 4, 0, kTimedTilePixels, 10.0, 300.0};
    EXPECT_FALSE(levels.drawn(picture)); // nor is making the shaders
    picture.volume = "w";
    EXPECT_EQ(levels.drawn(picture), 10.0);
    EXPECT_EQ(levels.drawn(picture), 310.0); // from then on it is swapping
}

TEST_F(SheetLevelsTest, WhatWasNotDrawnAgainWidensTheInterval) {
    const auto intervalOf = [&](double earlierMs) {
        SheetLevels fresh{LevelSettings{}, [] {}};
        fresh.redrawn({4, 40.0, 0, "raycast", 0, earlierMs});
        const auto point = fresh.timings().points.at(0);
        EXPECT_TRUE(point.partly);
        EXPECT_DOUBLE_EQ(point.ms.value, 40.0);
        return point.ms.high - point.ms.low;
    };
    EXPECT_GT(intervalOf(10.0), 0.0);
    EXPECT_NEAR(intervalOf(30.0), 3.0 * intervalOf(10.0), 1e-9);

    // Pictures that take the same each time leave little doubt.
    const DrawnPicture picture{"v", "raycast", 4, 0, kTimedTilePixels, 10.0, 0.0};
    for (int i = 0; i < 60; ++i)
        static_cast<void>(levels.drawn(picture));
    levels.redrawn({4, 40.0, 0, "raycast", 0, 30.0});
    const auto point = levels.timings().points.at(0);
    EXPECT_LT(point.ms.high - point.ms.low, 0.05 * intervalOf(30.0));
}

TEST_F(SheetLevelsTest, GuessesFromPartialRedrawsDoNotBreakTheRule) {
    LevelSettings slope;
    slope.policy = LevelPolicy::Slope;
    levels.setSettings(slope);
    std::vector<CellOnShow> shown;
    for (int n = 1; n <= 16; ++n) {
        auto next = cells().front();
        next.demand.volume = "n" + std::to_string(n);
        shown.push_back(next);
        const double ms =
            n <= 8 ? 10.0 * n : 80.0 + 20.0 * (n - 8); // as sharp a bend as breaks it when measured
        levels.redrawn({n, ms, 0, "raycast", 0, 0.9 * ms});
        EXPECT_EQ(levels.choose(shown, kAmpleBytes, true, false).front(), 0) << n;
    }
}

} // namespace
} // namespace voxsheet::stream
