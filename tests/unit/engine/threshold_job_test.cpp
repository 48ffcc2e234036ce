#include "engine/threshold_job.h"

#include "base/errors.h"
#include "engine/sample_reader.h"
#include "memory_dataset.h"
#include "store/store_volume_provider.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet::engine {
namespace {

constexpr double kRadius = 8.0;
const glm::dvec3 kCentre(12.0, 13.0, 14.0);

class ThresholdJob : public testing::Test {
protected:
    ThresholdJob()
        : store(std::make_shared<const store::VolumeStore>(folder.path() / "store")), results(store) {
        DatasetMeta meta = test::metaOf("ball", {28, 28, 28});
        meta.lengthUnit = "mm";
        // Positive inside, falling by 1 per voxel.
        test::addDataset(inputs, meta, [](int i, int j, int k) {
            return static_cast<float>(kRadius - glm::distance(glm::dvec3(i, j, k), kCentre));
        });
    }

    ThresholdTask task(double value, Comparison comparison = Comparison::Greater) {
        return {{inputs.describe("ball"), 0, 0}, {comparison, value}, "A1 > " + std::to_string(value)};
    }

    test::TemporaryFolder folder;
    MemoryVolumeProvider inputs;
    std::shared_ptr<const store::VolumeStore> store;
    store::StoreVolumeProvider results;
};

TEST_F(ThresholdJob, TheResultHoldsDistancesToTheSurfaceNegativeInside) {
    auto made = computeThreshold(task(0.0), *store, inputs, 0, {});
    const auto meta = made.meta();
    EXPECT_TRUE(made.commit());
    EXPECT_TRUE(holdsSignedDistances(*meta));
    EXPECT_EQ(meta->format, "threshold");
    EXPECT_EQ(meta->lengthUnit, "mm");
    EXPECT_EQ(meta->fields[0].unit, "mm");
    const Grid& grid = meta->grid;
    const auto values = readValues(results, *meta, {meta->key, 0, 0, 0}, 0, grid.dims.z);
    double worst = 0.0;
    for (int k = 0; k < grid.dims.z; ++k)
        for (int j = 0; j < grid.dims.y; ++j)
            for (int i = 0; i < grid.dims.x; ++i) {
                const glm::dvec3 p(grid.worldFromIndex * glm::dvec4(i, j, k, 1.0));
                const double exact = glm::distance(p, kCentre) - kRadius;
                const double at = values[static_cast<std::size_t>((k * grid.dims.y + j) * grid.dims.x + i)];
                worst = std::max(worst, std::abs(at - exact));
            }
    // 0.7 / radius in voxels of the net (signed_distance.h), and the interpolant's own flattening of a ball.
    EXPECT_LT(worst, 0.7 / kRadius + 0.1);
}

TEST_F(ThresholdJob, EqualComparisonsAreComputedOnceAndOthersHaveKeysOfTheirOwn) {
    auto first = computeThreshold(task(1.0), *store, inputs, 0, {});
    EXPECT_TRUE(first.commit());
    EXPECT_NE(thresholdEntryKey(task(1.0)), thresholdEntryKey(task(1.0000001)));
    EXPECT_NE(thresholdEntryKey(task(1.0)), thresholdEntryKey(task(1.0, Comparison::GreaterOrEqual)));
    EXPECT_EQ(thresholdEntryKey(task(0.0)), thresholdEntryKey(task(-0.0)));
    ThresholdTask other = task(1.0);
    other.text = "'ball' > 1";
    EXPECT_EQ(thresholdEntryKey(task(1.0)), thresholdEntryKey(other)) << "however it was written";
    other.input.step = 1;
    EXPECT_NE(thresholdEntryKey(task(1.0)), thresholdEntryKey(other));
    const ThresholdTask again = task(1.0);
    inputs.remove("ball"); // Only the store can answer now.
    EXPECT_EQ(computeThreshold(again, *store, inputs, 0, {}).meta()->key, first.meta()->key);
}

TEST_F(ThresholdJob, ABudgetThatIsTooSmallIsNamed) {
    const std::uint64_t needed = thresholdMemoryBytes(task(0.0));
    EXPECT_GT(needed, 28U * 28U * 28U * 4U);
    try {
        static_cast<void>(computeThreshold(task(0.0), *store, inputs, needed - 1, {}));
        FAIL();
    } catch (const LimitExceeded& error) {
        EXPECT_NE(std::string(error.what()).find("--memory-budget"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(static_cast<void>(computeThreshold(task(0.0), *store, inputs, needed, {})));
}

TEST_F(ThresholdJob, CancellingLeavesNothingBehindAndProgressRises) {
    JobControl control;
    control.cancelled = [] { return true; };
    EXPECT_THROW(static_cast<void>(computeThreshold(task(0.0), *store, inputs, 0, control)), Cancelled);
    EXPECT_FALSE(store->open(thresholdEntryKey(task(0.0))));
    std::vector<double> progress;
    control.cancelled = [] { return false; };
    control.progress = [&](double p) { progress.push_back(p); };
    static_cast<void>(computeThreshold(task(0.0), *store, inputs, 0, control));
    ASSERT_GE(progress.size(), 2U);
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
}

TEST_F(ThresholdJob, ASolidThatIsNowhereIsAVolumeToo) {
    const auto meta = computeThreshold(task(1e300), *store, inputs, 0, {}).meta();
    EXPECT_GT(meta->fields[0].steps[0].statistics.min, 0.0);
}

} // namespace
} // namespace voxsheet::engine
