#include "bench/time_n/time_n_result.h"

#include "base/errors.h"
#include "bench/svg_plot.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/time_n_arguments.h"
#include "bench/time_n/time_n_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace voxsheet::bench {
namespace {

TimeNPoint pointAt(int n, int level, double ms) {
    TimeNPoint point;
    point.n = n;
    point.level = level;
    point.ms = measuredMedian({&ms, 1});
    return point;
}

TEST(TimeNResult, SegmentsEndWhereTheLevelChanges) {
    std::vector<TimeNPoint> points;
    for (int n = 1; n <= 20; ++n)
        points.push_back(pointAt(n, n <= 12 ? 0 : 1, n <= 12 ? 10.0 * n : 3.0 * n));
    const auto segments = segmentsOf(points);
    ASSERT_EQ(segments.size(), 2U);
    EXPECT_EQ(segments[0].lastN, 12);
    EXPECT_EQ(segments[1].firstN, 13);
    EXPECT_EQ(segments[1].level, 1);
    EXPECT_NEAR(segments[1].line.slope, 3.0, 1e-6);
    EXPECT_NEAR(*segments[0].maxResidual, 0.0, 1e-6);
    EXPECT_NEAR(*segments[0].slopeRatio, 1.0, 1e-6);
}

TEST(TimeNResult, ResidualAndSlopeRatioShowABentSegment) {
    std::vector<TimeNPoint> points;
    for (int n = 1; n <= 40; ++n)
        points.push_back(pointAt(n, 0, 10.0 * n + 20.0 * std::max(0, n - 20)));
    const auto segments = segmentsOf(points);
    ASSERT_EQ(segments.size(), 1U);
    EXPECT_GT(*segments[0].maxResidual, 0.1);
    EXPECT_NEAR(*segments[0].slopeRatio, 3.0, 0.01);
}

TEST(TimeNResult, ShortSegmentsClaimNothing) {
    const auto segments = segmentsOf({pointAt(1, 0, 10.0), pointAt(2, 0, 20.0)});
    ASSERT_EQ(segments.size(), 1U);
    EXPECT_FALSE(segments[0].maxResidual);
    EXPECT_FALSE(segments[0].slopeRatio);
    EXPECT_TRUE(segmentsOf({}).empty());
}

TEST(TimeNResult, AbsentRegimesAreSaid) {
    TimeNResult result;
    result.points = {pointAt(1, 0, 10.0)};
    EXPECT_EQ(absentRegimes(result).size(), 2U);
    result.textureSwapN = 1;
    ASSERT_EQ(absentRegimes(result).size(), 1U);
    result.onDisk = false;
    EXPECT_NE(absentRegimes(result)[0].find("file system in memory"), std::string::npos);
    result.memorySwapN = 1;
    EXPECT_TRUE(absentRegimes(result).empty());
}

TEST(TimeNResult, CsvHasARowPerPointAndAsManyFieldsAsItsHeader) {
    TimeNResult result;
    result.points = {pointAt(1, 0, 10.0), pointAt(2, 0, 20.0)};
    result.trials = {pointAt(2, 0, 40.0)};
    result.trials.front().wallMs = 50.0;
    result.trials.front().slowdown = 1.25;
    result.options.rule.criterion = ResolutionCriterion::Slope;
    const auto csv = csvOf({&result, 1});
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 4 * 19);
    EXPECT_TRUE(csv.ends_with(",vr,0,slope,50,1.25\n")) << csv;
}

TEST(TimeNArguments, TilesAndRules) {
    EXPECT_EQ(parseTileSize("320x200"), glm::ivec2(320, 200));
    EXPECT_EQ(parseTileSize("128"), glm::ivec2(128));
    for (const char* text : {"", "x", "256x", "256x256x", "4x4", "99999x8", "-256x256"})
        EXPECT_THROW((void)parseTileSize(text), InvalidInput) << text;
    TimeNTexts texts;
    texts.dr = "time";
    texts.drLimit = 250.0;
    EXPECT_DOUBLE_EQ(withTexts({}, texts).front().rule.frameMs, 250.0);
    texts.drLimit = -1.0;
    EXPECT_THROW((void)withTexts({}, texts), InvalidInput);
    texts.dr = "slope";
    texts.drLimit = 2.0;
    EXPECT_THROW((void)withTexts({}, texts), InvalidInput);
    texts.drLimit.reset();
    texts.dr = "off,slope";
    const auto runs = withTexts({}, texts);
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[0].rule.criterion, ResolutionCriterion::Off);
    EXPECT_EQ(runs[1].rule.criterion, ResolutionCriterion::Slope);
    for (const char* text : {"", "off,", ",off", "off;slope", "steep"}) {
        texts.dr = text;
        EXPECT_THROW((void)withTexts({}, texts), InvalidInput) << text;
    }
    texts.dr = "off,count";
    texts.drLimit = 0.5; // less than one dataset is one
    EXPECT_EQ(withTexts({}, texts)[1].rule.datasets, 1);
    texts.drLimit.reset();
    texts.textureBudget = "-1G";
    EXPECT_THROW((void)withTexts({}, texts), InvalidInput);
}

TEST(BenchDatasets, AllDifferAndAreRemoved) {
    std::filesystem::path folder;
    {
        const BenchDatasets datasets(12, 24, [](int) {});
        folder = datasets.store()->folder();
        std::set<std::vector<std::byte>> contents;
        for (int index = 0; index < 12; ++index) {
            const auto entry = datasets.store()->open(datasets.key(index));
            ASSERT_TRUE(entry);
            std::vector<std::byte> samples(24 * 24 * 24);
            entry->readSlices({datasets.key(index), 0, 0, 0}, 0, 24, samples);
            contents.insert(samples);
        }
        EXPECT_EQ(contents.size(), 12U);
    }
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(BenchDatasets, TooLittleRoomIsSaidBeforeAnythingIsWritten) {
    EXPECT_THROW(BenchDatasets(1'000'000, 1024, [](int) { FAIL(); }), IoError);
}

TEST(SvgPlot, TicksAreRound) {
    EXPECT_EQ(roundTicks(65.0, 12), (std::vector<double>{0, 10, 20, 30, 40, 50, 60}));
    EXPECT_EQ(roundTicks(1.0, 5), (std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
    EXPECT_EQ(roundTicks(0.0, 5).size(), 1U);
}

TEST(SvgPlot, FiguresHoldEveryPoint) {
    TimeNResult result;
    result.options.maxN = 9;
    for (int n = 1; n <= 9; ++n)
        result.points.push_back(pointAt(n, 0, 10.0 * n));
    result.segments = segmentsOf(result.points);
    const auto svg = timeNFigure(result);
    std::size_t dots = 0;
    for (auto at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1))
        ++dots;
    EXPECT_EQ(dots, 9U + 9U + 3U); // T_N, the level, and the legends'
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

} // namespace
} // namespace voxsheet::bench
