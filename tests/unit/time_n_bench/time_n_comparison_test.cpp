#include "bench/time_n/time_n_comparison.h"

#include "bench/time_n/time_n_figure.h"

#include <gtest/gtest.h>

namespace voxsheet::bench {
namespace {

/// T_N = 10 N up to `bendAfter`, three times as steep beyond; at level 1 half of it.
TimeNResult invented(ResolutionCriterion criterion, int bendAfter, int largestN) {
    TimeNResult result;
    result.options.rule.criterion = criterion;
    result.options.maxN = largestN;
    const bool answers = criterion != ResolutionCriterion::Off;
    for (int n = 1; n <= largestN; ++n) {
        const int beyond = std::max(0, n - bendAfter);
        const int level = answers && beyond > 0 ? 1 : 0;
        const double ms = level == 1 ? 5.0 * n : 10.0 * n + 20.0 * beyond;
        TimeNPoint point;
        point.n = n;
        point.level = level;
        point.ms = measuredMedian({&ms, 1});
        result.points.push_back(point);
    }
    TimeNTransition transition;
    transition.bend = {bendAfter, bendAfter + 3, {3.0, 2.7, 3.3}, true};
    transition.cause = "texture budget";
    if (answers) transition.newLevel = 1;
    result.transitions = {transition};
    result.segments = segmentsOf(result.points);
    result.textureSwapN = bendAfter + 1;
    result.nMax = answers ? largestN : bendAfter;
    return result;
}

TEST(TimeNComparison, PairsRunsOfOneTechniqueAndShading) {
    auto shaded = invented(ResolutionCriterion::Off, 5, 12);
    shaded.options.scene.shading = true;
    const std::vector<TimeNResult> results{invented(ResolutionCriterion::Off, 8, 12), shaded,
                                           invented(ResolutionCriterion::Slope, 8, 12)};
    const auto pairs = comparisonsOf(results);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].without, &results[0]);
    EXPECT_EQ(pairs[0].with, &results[2]);
    EXPECT_TRUE(pairs[1].shading);
    EXPECT_EQ(pairs[1].without, &results[1]);
    EXPECT_EQ(pairs[1].with, nullptr);
}

TEST(TimeNComparison, SummaryHasEveryTransitionAndBothLargestN) {
    const std::vector<TimeNResult> results{invented(ResolutionCriterion::Off, 8, 12),
                                           invented(ResolutionCriterion::Slope, 8, 12)};
    const auto table = summaryTable(results);
    EXPECT_NE(
        table.find("| vr | N = 8 (R 3.00, texture budget) | 8 | ≥ 12 | N = 8 (R 3.00, texture budget, to "
                   "level 1) | level 0, N = 1 to 8: 0 %, 1.00; level 1, N = 9 to 12: 0 % |"),
        std::string::npos)
        << table;
    EXPECT_NE(table.find("- vr, --dr off: no reading from disk appears"), std::string::npos) << table;
    EXPECT_EQ(summaryJson(results),
              "[{\"technique\":\"vr\",\"shading\":false,\"n_max_without\":8,\"n_max_with\":12,"
              "\"n_measured_without\":12,\"n_measured_with\":12,\"texture_swapping_from\":9,"
              "\"disk_reading_from\":null,"
              "\"transitions_without\":[{\"n\":8,\"ratio\":3,\"cause\":\"texture budget\",\"level\":null}],"
              "\"level_changes\":[{\"n\":8,\"ratio\":3,\"cause\":\"texture budget\",\"level\":1}]}]");
}

TEST(TimeNComparison, ACurveThatFlattensHasNoTransitionThere) {
    auto result = invented(ResolutionCriterion::Off, 8, 12);
    result.transitions.front().bend.breaksRule = false;
    result.transitions.front().bend.ratio = {0.7, 0.6, 0.8};
    EXPECT_NE(summaryTable({&result, 1}).find("| vr | none | 8 |"), std::string::npos);
    EXPECT_EQ(timeNFigure(result).find("R = 0.70"), std::string::npos);
}

TEST(TimeNComparison, ARunThatIsNotThereIsSaid) {
    const std::vector<TimeNResult> results{invented(ResolutionCriterion::Slope, 8, 12)};
    EXPECT_NE(summaryTable(results).find("| vr | not measured | not measured |"), std::string::npos);
    EXPECT_NE(summaryJson(results).find("\"n_max_without\":null"), std::string::npos);
}

TEST(TimeNComparison, FigureHoldsBothCurvesAndWhatDidNotAppear) {
    const auto svg = comparisonFigure(invented(ResolutionCriterion::Off, 8, 12),
                                      invented(ResolutionCriterion::Slope, 8, 12));
    for (const char* text :
         {"DR off<", "level 0 (full resolution)", "level 1", "(VR): N max 8 without DR, ≥ 12 with", "R = 1.5",
          "DR off: no reading from disk appears", "DR slope: no reading from disk appears"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

} // namespace
} // namespace voxsheet::bench
