#include "resolution/level_policy.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace voxsheet {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;
const SheetBudget kAmple{1e9, std::uint64_t{1} << 50U};

/// A cube of 2^(20 + levels) bytes and so on; each level takes half the time of the finer one.
CellDemand cell(std::string volume, double texelEdgePixels, double msAtLevelZero = 0.0, int levels = 5) {
    CellDemand demand;
    demand.volume = std::move(volume);
    demand.texelEdgePixels = texelEdgePixels;
    demand.pixels = 256.0 * 256.0;
    for (int level = 0; level < levels; ++level) {
        demand.textureBytes.push_back((32 * kMiB) >> (3 * level));
        demand.ms.push_back(std::ldexp(msAtLevelZero, -level));
    }
    return demand;
}

std::vector<CellDemand> equalCells(int count, double texelEdgePixels, double ms) {
    std::vector<CellDemand> cells;
    for (int i = 0; i < count; ++i)
        cells.push_back(cell("v" + std::to_string(i), texelEdgePixels, ms));
    return cells;
}

TEST(LevelPolicy, NamesReadBack) {
    for (const std::string& name : levelPolicyNames())
        EXPECT_EQ(levelPolicyName(levelPolicyFromName(name)), name);
    try {
        (void)levelPolicyFromName("nonsense");
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), "policy");
        EXPECT_NE(std::string(error.what()).find("slope-first"), std::string::npos);
    }
}

TEST(LevelPolicy, SettingsOutOfRangeNameTheirField) {
    const auto fieldOf = [](auto change) {
        LevelSettings settings;
        change(settings);
        try {
            validateLevelSettings(settings);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("none");
    };
    EXPECT_EQ(fieldOf([](LevelSettings&) {}), "none");
    EXPECT_EQ(fieldOf([](LevelSettings& s) { s.frameMs = 0.0; }), "frame_ms");
    EXPECT_EQ(fieldOf([](LevelSettings& s) { s.frameMs = std::nan(""); }), "frame_ms");
    EXPECT_EQ(fieldOf([](LevelSettings& s) { s.framesPerSecond = -1.0; }), "frames_per_second");
    EXPECT_EQ(fieldOf([](LevelSettings& s) { s.datasets = 0; }), "datasets");
    EXPECT_EQ(fieldOf([](LevelSettings& s) { s.bytes = 0; }), "bytes");
    EXPECT_EQ(fieldOf([](LevelSettings& s) { s.upFraction = 1.5; }), "up_fraction");
}

TEST(LevelPolicy, FootprintIsTheCoarsestLevelWithoutATexelLargerThanAPixel) {
    EXPECT_EQ(footprintLevel(2.0, 5), 0);
    EXPECT_EQ(footprintLevel(0.51, 5), 0);
    EXPECT_EQ(footprintLevel(0.5, 5), 1);
    EXPECT_EQ(footprintLevel(0.26, 5), 1);
    EXPECT_EQ(footprintLevel(0.25, 5), 2);
    EXPECT_EQ(footprintLevel(1e-9, 5), 4);
    EXPECT_EQ(footprintLevel(std::numeric_limits<double>::infinity(), 5), 0);
}

TEST(LevelPolicy, AmpleBudgetsLeaveEachCellAtItsFootprint) {
    std::vector<CellDemand> cells{cell("a", 1.5, 100), cell("b", 0.4, 100), cell("c", 0.2, 100)};
    cells[2].finest = 3;
    EXPECT_EQ(focusLevels(cells, kAmple), (std::vector<int>{0, 1, 3}));
    cells[0].pinned = 4;
    cells[1].pinned = 99;
    EXPECT_EQ(focusLevels(cells, kAmple), (std::vector<int>{4, 4, 3}));
}

TEST(LevelPolicy, TimeBudgetLowersTheOthersBeforeTheFocusedCell) {
    auto cells = equalCells(8, 1.0, 100.0);
    cells[3].focused = true;
    const SheetBudget budget{500.0, kAmple.textureBytes};
    const auto levels = focusLevels(cells, budget);
    EXPECT_LE(sheetCost(cells, levels).ms, budget.frameMs);
    EXPECT_EQ(levels[3], 0);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (i == 3) continue;
        EXPECT_GE(levels[i], 0);
        EXPECT_LE(levels[i], 1); // 100 + 7 * 50 = 450 fits: nobody falls by two
    }
}

TEST(LevelPolicy, MemoryBudgetLowersAVolumeForAllItsCells) {
    std::vector<CellDemand> cells{cell("a", 1.0), cell("a", 1.0), cell("b", 1.0)};
    const SheetBudget budget{kAmple.frameMs, 40 * kMiB};
    const auto levels = focusLevels(cells, budget);
    EXPECT_LE(sheetCost(cells, levels).textureBytes, budget.textureBytes);
    EXPECT_EQ(levels[0], levels[1]);
    EXPECT_EQ(levels[0] + levels[2], 1); // one of the two volumes, not both
    EXPECT_EQ(levels[2], 1);             // the one whose level serves fewer pictures
}

TEST(LevelPolicy, PinnedCellsStayAndBudgetsThatNothingCanMeetEnd) {
    auto cells = equalCells(3, 1.0, 100.0);
    for (auto& each : cells)
        each.pinned = 0;
    EXPECT_EQ(focusLevels(cells, {1.0, 1}), (std::vector<int>{0, 0, 0}));
    cells[1].pinned.reset();
    EXPECT_EQ(focusLevels(cells, {1.0, 1}), (std::vector<int>{0, 4, 0}));
    EXPECT_TRUE(focusLevels({}, {1.0, 1}).empty());
}

TEST(LevelPolicy, LargePicturesKeepTheirLevelLonger) {
    auto cells = equalCells(2, 1.0, 100.0);
    cells[0].pixels *= 4.0;
    EXPECT_EQ(focusLevels(cells, {150.0, kAmple.textureBytes}), (std::vector<int>{0, 1}));
}

TEST(LevelPolicy, RandomSheetsMeetTheirBudgetsOrAreAsCoarseAsTheyGet) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int run = 0; run < 300; ++run) {
        std::vector<CellDemand> cells;
        const int count = 1 + static_cast<int>(uniform(random) * 40);
        for (int i = 0; i < count; ++i) {
            auto each = cell("v" + std::to_string(static_cast<int>(uniform(random) * 20)),
                             std::exp2(4.0 * uniform(random) - 3.0), 100.0 * uniform(random));
            each.pixels = 1e4 + 1e5 * uniform(random);
            each.focused = i == 0;
            if (uniform(random) < 0.1) each.pinned = static_cast<int>(uniform(random) * 5);
            cells.push_back(std::move(each));
        }
        const SheetBudget budget{std::exp2(10.0 * uniform(random)),
                                 static_cast<std::uint64_t>(std::exp2(15.0 + 16.0 * uniform(random)))};
        const auto levels = focusLevels(cells, budget);
        const auto cost = sheetCost(cells, levels);
        const auto ample = focusLevels(cells, kAmple);
        bool canMove = false;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            ASSERT_GE(levels[i], ample[i]);
            ASSERT_LT(levels[i], cells[i].levels());
            if (cells[i].pinned) {
                ASSERT_EQ(levels[i], *cells[i].pinned);
            }
            canMove = canMove || (!cells[i].pinned && levels[i] + 1 < cells[i].levels());
        }
        // Rounding: the running sums differ from the sum at the end by less than a millionth.
        if (cost.ms > budget.frameMs * (1 + 1e-6)) {
            ASSERT_FALSE(canMove) << run;
        }
    }
}

TEST(LevelPolicy, HysteresisKeepsLevelsWhileCostsWaver) {
    auto cells = equalCells(10, 1.0, 100.0);
    const SheetBudget budget{1000.0, kAmple.textureBytes};
    std::vector<std::optional<int>> previous(cells.size());
    std::vector<int> levels;
    int changes = 0;
    for (int round = 0; round < 40; ++round) {
        for (auto& each : cells)
            for (int level = 0; level < each.levels(); ++level)
                each.ms[static_cast<std::size_t>(level)] =
                    std::ldexp(round % 2 == 0 ? 99.0 : 103.0, -level); // 990 or 1030 ms
        const auto next = steadyFocusLevels(cells, previous, budget, 0.8);
        if (round > 1 && next != levels) ++changes;
        levels = next;
        for (std::size_t i = 0; i < levels.size(); ++i)
            previous[i] = levels[i];
        EXPECT_LE(sheetCost(cells, levels).ms, budget.frameMs);
    }
    EXPECT_EQ(changes, 0);
    // Far below the budget the finer levels come back.
    for (auto& each : cells)
        for (double& ms : each.ms)
            ms *= 0.5;
    EXPECT_EQ(steadyFocusLevels(cells, previous, budget, 0.8), std::vector<int>(10, 0));
}

TEST(LevelPolicy, CommonLevelIsClampedToEachCell) {
    std::vector<CellDemand> cells{cell("a", 1.0), cell("b", 1.0, 0.0, 2), cell("c", 1.0), cell("d", 1.0)};
    cells[2].pinned = 0;
    cells[3].finest = 3;
    EXPECT_EQ(commonLevels(cells, 2), (std::vector<int>{2, 1, 0, 3}));
}

TEST(LevelPolicy, FourHundredVolumesAreQuick) {
    // Each lowering step looks at every volume once; 400 volumes by 4 steps must not take visible time.
    const auto cells = equalCells(400, 1.0, 100.0);
    const auto levels = focusLevels(cells, {400 * 100.0 / 16.0, kAmple.textureBytes});
    EXPECT_LE(sheetCost(cells, levels).ms, 400 * 100.0 / 16.0 * (1 + 1e-9));
}

TEST(LevelPolicy, AFurtherVolumeCountsOncePerLevelWhoeverReadsIt) {
    CellDemand own = cell("b", 4.0);
    CellDemand one = cell("a", 4.0);
    one.further = {{"b", own.textureBytes}};
    CellDemand two = cell("c", 4.0);
    two.further = {{"b", {own.textureBytes[0]}}}; // has one level only
    const std::uint64_t full = 32 * kMiB;
    const std::vector<CellDemand> cells{own, one, two};
    EXPECT_EQ(sheetCost(cells, std::vector<int>{0, 0, 0}).textureBytes, 3 * full);
    EXPECT_EQ(sheetCost(cells, std::vector<int>{0, 1, 0}).textureBytes, full + full + 2 * full / 8);
    EXPECT_EQ(sheetCost(cells, std::vector<int>{1, 1, 1}).textureBytes, full + 3 * full / 8);
}

TEST(LevelPolicy, FusedLayersAreKeptWithinTheBytesOfTheSheet) {
    std::mt19937 random(11);
    for (int run = 0; run < 200; ++run) {
        std::vector<CellDemand> cells = equalCells(8, 4.0, 0.0);
        for (CellDemand& each : cells) {
            const auto layers = random() % 3;
            for (std::uint32_t i = 0; i < layers; ++i)
                each.further.push_back({"v" + std::to_string(random() % 12), each.textureBytes});
        }
        const SheetBudget budget{1e9, (8 + random() % 200) * kMiB};
        const auto levels = focusLevels(cells, budget);
        EXPECT_LE(sheetCost(cells, levels).textureBytes, budget.textureBytes) << "run " << run;
        EXPECT_EQ(focusLevels(cells, kAmple), std::vector<int>(8, 0));
    }
}

} // namespace
} // namespace voxsheet
