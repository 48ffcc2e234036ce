#include "engine/default_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace voxsheet::engine {
namespace {

ValueSummary summaryOf(std::vector<float> values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double min = *low;
    const double max = *high;
    return summariseValues(values, min, max);
}

/// Air round a body: `airShare` of noise near `air`, the rest near `tissue`.
ValueSummary airAndTissue(float air, float tissue, float spread, double airShare) {
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0.0F, spread);
    std::vector<float> values;
    for (int i = 0; i < 20000; ++i)
        values.push_back((i < airShare * 20000 ? air : tissue) + noise(random));
    return summaryOf(std::move(values));
}

ValueSummary difference(double rms, double extreme) {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.0F, static_cast<float>(rms));
    std::vector<float> values;
    for (int i = 0; i < 20000; ++i)
        values.push_back(noise(random));
    values.push_back(static_cast<float>(extreme));
    values.push_back(static_cast<float>(-extreme));
    return summaryOf(std::move(values));
}

TransferFunction over(const ValueWindow& window) {
    TransferFunction function;
    function.low = window.low;
    function.high = window.high;
    return function;
}

double opacityAt(const std::vector<OpacityPoint>& points, double position) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (position > points[i].position) continue;
        const double width = points[i].position - points[i - 1].position;
        const double w = width > 0 ? (position - points[i - 1].position) / width : 1.0;
        return points[i - 1].opacity + w * (points[i].opacity - points[i - 1].opacity);
    }
    return points.back().opacity;
}

void expectWellFormed(const std::vector<OpacityPoint>& points) {
    ASSERT_GE(points.size(), 2U);
    EXPECT_EQ(points.front().position, 0.0);
    EXPECT_EQ(points.back().position, 1.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_TRUE(points[i].opacity >= 0.0 && points[i].opacity <= 1.0);
        if (i > 0) {
            EXPECT_GE(points[i].position, points[i - 1].position);
        }
    }
}

TEST(ValueSummary, QuantilesInterpolateAndLeaveOutWhatIsNotFinite) {
    std::vector<float> values;
    for (int i = 0; i <= 1000; ++i)
        values.push_back(static_cast<float>(i));
    values.push_back(std::nanf(""));
    values.push_back(INFINITY);
    const ValueSummary summary = summariseValues(values, 0, 1000);
    EXPECT_NEAR(summary.quantile(0.5), 500, 1);
    EXPECT_EQ(summary.quantile(0.0), 0);
    EXPECT_EQ(summary.quantile(1.0), 1000);
    EXPECT_EQ(ValueSummary{}.quantile(0.5), 0.0);
}

TEST(DefaultLook, TheBackgroundIsWhereMostSamplesAre) {
    EXPECT_NEAR(backgroundValue(airAndTissue(0, 1000, 10, 0.6)), 0, 20);
    EXPECT_NEAR(backgroundValue(airAndTissue(1000, 0, 10, 0.6)), 1000, 20);
}

TEST(DefaultLook, DifferencesDivergeButCtDoesNot) {
    EXPECT_TRUE(opensDiverging(difference(2.0, 33.0)));
    EXPECT_FALSE(opensDiverging(airAndTissue(-1000, 60, 20, 0.5))) << "air at -1000 HU is no signed quantity";
    EXPECT_FALSE(opensDiverging(airAndTissue(0, 100, 1, 0.7))) << "noise round zero is no signed quantity";
    EXPECT_FALSE(opensDiverging(airAndTissue(-1000, 40, 20, 0.3)))
        << "nor where the body fills most of the box";
    ValueSummary scan = difference(300.0, 900.0);
    scan.integers = true;
    EXPECT_FALSE(opensDiverging(scan)) << "plain integers are counts";
    EXPECT_FALSE(opensDiverging(ValueSummary{}));
}

TEST(DefaultLook, AFewExtremeSamplesDoNotSetTheWindow) {
    const ValueWindow window = defaultWindow(difference(2.0, 1000.0));
    EXPECT_LT(window.high, 20);
    EXPECT_EQ(window.low, -window.high) << "signed data are symmetric about zero";
}

TEST(DefaultLook, AnOrdinaryRangeIsKeptWhole) {
    std::vector<float> values;
    for (int i = 0; i <= 255; ++i)
        values.push_back(static_cast<float>(i));
    EXPECT_EQ(defaultWindow(summaryOf(values)), (ValueWindow{0, 255}));
}

TEST(DefaultLook, AConstantFieldHasAWindow) {
    const ValueSummary summary = summaryOf(std::vector<float>(100, 5.0F));
    const ValueWindow window = defaultWindow(summary);
    EXPECT_LT(window.low, 5);
    EXPECT_GT(window.high, 5);
    const ValueWindow zero = defaultWindow(summaryOf(std::vector<float>(100, 0.0F)));
    EXPECT_LT(zero.low, zero.high);
    expectWellFormed(defaultOpacity(summary, over(window), false, 64));
    EXPECT_LT(defaultWindow(ValueSummary{}).low, defaultWindow(ValueSummary{}).high);
}

TEST(DefaultLook, AirIsTransparentAndTissueIsNot) {
    const ValueSummary head = airAndTissue(0, 1000, 60, 0.65);
    const TransferFunction function = over(defaultWindow(head));
    const auto opacity = defaultOpacity(head, function, false, 100);
    expectWellFormed(opacity);
    EXPECT_EQ(opacityAt(opacity, transferPosition(function, 100)), 0.0);
    EXPECT_GT(opacityAt(opacity, transferPosition(function, 1000)), 0.0);
}

TEST(DefaultLook, ABrightBackgroundIsTransparentToo) {
    const ValueSummary wells = airAndTissue(8, -60, 2, 0.8);
    const TransferFunction function = over(defaultWindow(wells));
    const auto opacity = defaultOpacity(wells, function, false, 80);
    expectWellFormed(opacity);
    EXPECT_EQ(opacityAt(opacity, transferPosition(function, 8)), 0.0);
    EXPECT_GT(opacityAt(opacity, transferPosition(function, -60)), 0.0);
}

TEST(DefaultLook, AFlagFarBelowTheBackgroundNeitherHidesNorFlattensTheRest) {
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0.0F, 60.0F);
    std::vector<float> values;
    for (int i = 0; i < 20000; ++i)
        values.push_back(i < 300 ? -15000.0F : (i < 14000 ? 0.0F : 1000.0F) + noise(random));
    ValueSummary head = summaryOf(std::move(values));
    head.integers = true;
    const TransferFunction function = over(defaultWindow(head));
    EXPECT_GT(function.low, -2000);
    const auto opacity = defaultOpacity(head, function, false, 100);
    expectWellFormed(opacity);
    EXPECT_GT(opacityAt(opacity, transferPosition(function, 1000)), 0.0);
    EXPECT_EQ(opacityAt(opacity, 0.0), 0.0);
}

TEST(DefaultLook, SignedDataAreTransparentAtZeroAndOpaqueAtBothEnds) {
    const ValueSummary summary = difference(2.0, 33.0);
    const auto opacity = defaultOpacity(summary, over(defaultWindow(summary)), true, 80);
    expectWellFormed(opacity);
    EXPECT_EQ(opacityAt(opacity, 0.5), 0.0);
    EXPECT_GT(opacityAt(opacity, 0.0), 0.01);
    EXPECT_NEAR(opacityAt(opacity, 0.0), opacityAt(opacity, 1.0), 1e-6);
}

TEST(DefaultLook, TheMeanOpticalDepthIsTheTargetHoweverLongThePath) {
    const ValueSummary head = airAndTissue(0, 1000, 60, 0.65);
    const TransferFunction function = over(defaultWindow(head));
    for (const double path : {20.0, 100.0, 500.0}) {
        const auto opacity = defaultOpacity(head, function, false, path);
        double depth = 0.0;
        for (const double value : head.quantiles) {
            depth -= std::log1p(-opacityAt(opacity, std::clamp(transferPosition(function, value), 0.0, 1.0)));
        }
        depth *= path / static_cast<double>(head.quantiles.size());
        EXPECT_NEAR(depth, kTargetDepth, 0.15 * kTargetDepth) << path;
    }
}

TEST(DefaultLook, ProjectionsAreOpaqueSoonAfterTheBackground) {
    const ValueSummary head = airAndTissue(0, 1000, 30, 0.65);
    const auto opacity = defaultProjectionOpacity(head, over(defaultWindow(head)), false);
    expectWellFormed(opacity);
    EXPECT_NEAR(opacityAt(opacity, 1.0), 1.0, 1e-9);
}

} // namespace
} // namespace voxsheet::engine
