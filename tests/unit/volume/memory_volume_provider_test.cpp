#include "base/errors.h"
#include "volume/memory_volume_provider.h"
#include "volume/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

namespace voxsheet {
namespace {

DatasetMeta rampMeta(const std::string& key, glm::ivec3 dims) {
    DatasetMeta meta;
    meta.key = key;
    meta.grid.dims = dims;
    auto& field = meta.fields.emplace_back();
    field.name = "ramp";
    field.storedType = ScalarType::U16;
    return meta;
}

std::vector<std::byte> ramp(glm::ivec3 dims) {
    std::vector<unsigned short> samples(static_cast<std::size_t>(sampleCount(dims)));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<unsigned short>(i);
    std::vector<std::byte> bytes(samples.size() * 2);
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    return bytes;
}

TEST(MemoryVolumeProvider, GivesSlicesLevelsAndStatistics) {
    const glm::ivec3 dims(20, 10, 5);
    MemoryVolumeProvider volumes;
    volumes.add(rampMeta("a", dims), {ramp(dims)});

    const auto meta = volumes.describe("a");
    EXPECT_EQ(meta->levels(), 2);
    EXPECT_EQ(meta->fields[0].steps[0].statistics.max, 999.0);

    std::vector<std::byte> slices(20 * 10 * 2 * 2);
    volumes.readSlices({"a", 0, 0, 0}, 3, 2, slices);
    unsigned short first = 0;
    std::memcpy(&first, slices.data(), 2);
    EXPECT_EQ(first, 600);

    std::vector<std::byte> coarse(10 * 5 * 3 * 2);
    EXPECT_NO_THROW(volumes.readSlices({"a", 0, 0, 1}, 0, 3, coarse));
    EXPECT_EQ(volumes.readMinMax({"a", 0, 0, 0}).bricks, glm::ivec3(10, 5, 3));
    EXPECT_EQ(volumes.readMinMax({"a", 0, 0, 1}).bricks, glm::ivec3(5, 3, 2));
}

TEST(MemoryVolumeProvider, NamesWhatIsNotThere) {
    const glm::ivec3 dims(4, 4, 4);
    MemoryVolumeProvider volumes;
    volumes.add(rampMeta("a", dims), {ramp(dims)});
    std::vector<std::byte> out(32);
    EXPECT_THROW((void)volumes.describe("b"), NotFound);
    EXPECT_THROW(volumes.readSlices({"a", 1, 0, 0}, 0, 1, out), NotFound);
    EXPECT_THROW(volumes.readSlices({"a", 0, 1, 0}, 0, 1, out), NotFound);
    EXPECT_THROW(volumes.readSlices({"a", 0, 0, 1}, 0, 1, out), NotFound);
    EXPECT_THROW(volumes.readSlices({"a", 0, 0, 0}, 4, 1, out), InvalidInput);
    EXPECT_THROW(volumes.readSlices({"a", 0, 0, 0}, 0, 2, out), InvalidInput);
    EXPECT_THROW(volumes.add(rampMeta("a", dims), {ramp(dims)}), Conflict);
    EXPECT_THROW(volumes.add(rampMeta("c", dims), {}), InvalidInput);
    EXPECT_THROW(volumes.add(rampMeta("c", dims), {ramp({4, 4, 3})}), InvalidInput);
}

TEST(ParallelFor, CoversEachIndexOnceAndPassesExceptionsOn) {
    std::vector<std::atomic<int>> seen(1000);
    parallelFor(1000, 7, [&](long begin, long end) {
        for (long i = begin; i < end; ++i)
            ++seen[static_cast<std::size_t>(i)];
    });
    for (const auto& n : seen)
        EXPECT_EQ(n.load(), 1);
    EXPECT_THROW(parallelFor(100, 1,
                             [](long begin, long) {
                                 if (begin == 50) throw InvalidInput("index 50", "it is refused");
                             }),
                 InvalidInput);
}

} // namespace
} // namespace voxsheet
