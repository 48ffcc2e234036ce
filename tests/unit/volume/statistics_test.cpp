#include "volume/grid.h"
#include "volume/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace voxsheet {
namespace {

template <typename T>
FieldStep statisticsOf(ScalarType type, const std::vector<T>& samples, double scale = 1.0,
                       double offset = 0.0) {
    return computeStatistics(
        {type, {static_cast<int>(samples.size()), 1, 1}, std::as_bytes(std::span(samples)), scale, offset});
}

TEST(Statistics, OfKnownNumbers) {
    const auto step = statisticsOf<double>(ScalarType::F64, {2, 4, 4, 4, 5, 5, 7, 9});
    EXPECT_EQ(step.statistics.min, 2.0);
    EXPECT_EQ(step.statistics.max, 9.0);
    EXPECT_DOUBLE_EQ(step.statistics.mean, 5.0);
    EXPECT_DOUBLE_EQ(step.statistics.standardDeviation, 2.0);
    EXPECT_EQ(step.statistics.finiteCount, 8U);
    EXPECT_EQ(step.statistics.nanCount, 0U);
}

TEST(Statistics, CountedAndSummedTypesAgree) {
    std::mt19937 random(5);
    std::vector<short> small(300000);
    for (auto& s : small)
        s = static_cast<short>(random());
    const std::vector<int> wide(small.begin(), small.end());
    const auto a = statisticsOf(ScalarType::I16, small, -0.25, 3.0);
    const auto b = statisticsOf(ScalarType::I32, wide, -0.25, 3.0);
    EXPECT_EQ(a.statistics.min, b.statistics.min);
    EXPECT_EQ(a.statistics.max, b.statistics.max);
    EXPECT_NEAR(a.statistics.mean, b.statistics.mean, 1e-8);
    EXPECT_NEAR(a.statistics.standardDeviation, b.statistics.standardDeviation, 1e-8);
    EXPECT_EQ(a.histogram.counts, b.histogram.counts);
}

TEST(Statistics, NanAndInfinityAreLeftOut) {
    const float inf = std::numeric_limits<float>::infinity();
    const auto step = statisticsOf<float>(ScalarType::F32, {1.0F, std::nanf(""), inf, 3.0F, -inf});
    EXPECT_EQ(step.statistics.min, 1.0);
    EXPECT_EQ(step.statistics.max, 3.0);
    EXPECT_EQ(step.statistics.mean, 2.0);
    EXPECT_EQ(step.statistics.finiteCount, 2U);
    EXPECT_EQ(step.statistics.nanCount, 3U);
}

TEST(Statistics, NothingFiniteGivesZeros) {
    const auto step = statisticsOf<float>(ScalarType::F32, {std::nanf(""), std::nanf("")});
    EXPECT_EQ(step.statistics.finiteCount, 0U);
    EXPECT_EQ(step.statistics.min, 0.0);
    EXPECT_EQ(step.statistics.max, 0.0);
    EXPECT_EQ(step.histogram.counts, std::vector<std::uint64_t>(kHistogramBins, 0));
}

TEST(Statistics, EachOf256ValuesHasItsBin) {
    std::vector<unsigned char> samples(256);
    std::iota(samples.begin(), samples.end(), static_cast<unsigned char>(0));
    samples.push_back(255);
    const auto step = statisticsOf(ScalarType::U8, samples);
    std::uint64_t total = 0;
    for (const auto n : step.histogram.counts)
        total += n;
    EXPECT_EQ(total, samples.size());
    EXPECT_GE(step.histogram.counts.back(), 2U) << "the largest value belongs to the last bin";
    EXPECT_GE(step.histogram.counts.front(), 1U);
}

TEST(Statistics, EqualValuesAreInBinZero) {
    const auto step = statisticsOf<float>(ScalarType::F32, std::vector<float>(100, -7.5F));
    EXPECT_EQ(step.histogram.counts[0], 100U);
    EXPECT_EQ(step.statistics.min, step.statistics.max);
    EXPECT_EQ(step.statistics.standardDeviation, 0.0);
}

TEST(Statistics, LargeOffsetsKeepTheSpread) {
    // A naive sum of squares loses the spread of 1 beside 1e9.
    std::vector<double> samples(1000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = 1e9 + (i % 2 ? 1.0 : -1.0);
    EXPECT_NEAR(statisticsOf(ScalarType::F64, samples).statistics.standardDeviation, 1.0, 1e-6);
}

TEST(Statistics, ValuesAtTheEndsOfDouble) {
    const double big = std::numeric_limits<double>::max();
    const auto step = statisticsOf<double>(ScalarType::F64, {-big, big});
    EXPECT_EQ(step.histogram.counts.front(), 1U);
    EXPECT_EQ(step.histogram.counts.back(), 1U);
}

} // namespace
} // namespace voxsheet
