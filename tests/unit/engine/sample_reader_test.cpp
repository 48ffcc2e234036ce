#include "engine/sample_reader.h"
#include "memory_dataset.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet::engine {
namespace {

float ramp(int i, int j, int k) { return static_cast<float>(i + 10 * j + 100 * k); }

TEST(SampleReader, ValuesAreScaledSourceNumbers) {
    MemoryVolumeProvider provider;
    DatasetMeta meta = test::metaOf("a", {4, 3, 5});
    meta.fields[0].valueScale = 2.0;
    meta.fields[0].valueOffset = -1.0;
    test::addDataset(provider, meta, ramp);
    const auto values = readValues(provider, *provider.describe("a"), {"a", 0, 0, 0}, 2, 1);
    ASSERT_EQ(values.size(), 12U);
    EXPECT_EQ(values[0], 2.0 * 200 - 1);
    EXPECT_EQ(values[11], 2.0 * 223 - 1);
}

TEST(SampleReader, ASummaryOfALargeFieldComesFromACoarseLevelButKeepsTheExtremes) {
    MemoryVolumeProvider provider;
    test::addDataset(provider, test::metaOf("a", {96, 96, 96}), [](int i, int j, int k) {
        return i == 5 && j == 5 && k == 5 ? 1000.0F : static_cast<float>(i % 7);
    });
    const ValueSummary summary = summariseField(provider, *provider.describe("a"), 0, 0);
    EXPECT_EQ(summary.max, 1000);
    EXPECT_EQ(summary.min, 0);
    EXPECT_NEAR(summary.quantile(0.5), 3, 1.1);
}

TEST(SamplePoint, InterpolatesLinearlyAndNamesTheNearestSample) {
    MemoryVolumeProvider provider;
    test::addDataset(provider, test::metaOf("a", {4, 3, 5}), ramp);
    const auto meta = provider.describe("a");
    const auto sample = samplePoint(provider, *meta, 0, 0, {}, {1.25, 1.0, 2.5});
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->nearest, glm::ivec3(1, 1, 3));
    EXPECT_EQ(sample->value.value(), 311);
    EXPECT_NEAR(sample->interpolated.value(), 1.25 + 10 + 250, 1e-9);
    EXPECT_FALSE(samplePoint(provider, *meta, 0, 0, {}, {-0.2, 1, 1}))
        << "point data end at the first sample";
}

TEST(SamplePoint, WrapsOnPeriodicAxes) {
    MemoryVolumeProvider provider;
    DatasetMeta meta = test::metaOf("p", {4, 3, 5});
    meta.grid.periodic = glm::bvec3(true);
    test::addDataset(provider, meta, ramp);
    const auto sample = samplePoint(provider, *provider.describe("p"), 0, 0, {}, {3.5, 0, 0});
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->interpolated.value(), 1.5, 1e-9) << "between sample 3 and sample 0";
    const auto at = [&](const PeriodicWindow& window, const glm::dvec3& world) {
        return samplePoint(provider, *provider.describe("p"), 0, 0, window, world);
    };
    const auto shifted = at({{0.5, 0.0, 0.0}, glm::ivec3(1)}, {2.0, 1.0, 0.0});
    ASSERT_TRUE(shifted);
    EXPECT_EQ(shifted->value.value(), 10) << "what lay at 0 lies at 2";
    EXPECT_EQ(shifted->nearest, glm::ivec3(0, 1, 0)) << "the index in the file";
    EXPECT_FALSE(at({}, {6.0, 1.0, 0.0}));
    const auto second = at({glm::dvec3(0.0), {2, 1, 1}}, {6.0, 1.0, 0.0});
    ASSERT_TRUE(second);
    EXPECT_EQ(second->value.value(), 12);
    EXPECT_FALSE(at({glm::dvec3(0.0), {2, 1, 1}}, {8.1, 1.0, 0.0}));
}

TEST(SamplePoint, ASampleThatTouchesNanIsAbsentButItsNeighbourIsNot) {
    MemoryVolumeProvider provider;
    test::addDataset(provider, test::metaOf("n", {4, 3, 5}),
                     [](int i, int, int) { return i == 2 ? std::nanf("") : 1.0F; });
    const auto meta = provider.describe("n");
    const auto between = samplePoint(provider, *meta, 0, 0, {}, {1.4, 0, 0});
    ASSERT_TRUE(between);
    EXPECT_EQ(between->value.value(), 1.0);
    EXPECT_FALSE(between->interpolated);
    const auto on = samplePoint(provider, *meta, 0, 0, {}, {1.0, 0, 0});
    EXPECT_EQ(on.value().interpolated.value(), 1.0) << "a weight of zero touches nothing";
}

} // namespace
} // namespace voxsheet::engine
