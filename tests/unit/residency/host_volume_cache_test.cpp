#include "residency/host_volume_cache.h"

#include "base/errors.h"
#include "volume/memory_volume_provider.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <random>
#include <thread>
#include <utility>

namespace voxsheet {
namespace {

const glm::ivec3 kDims(256, 128, 80); ///< U16: 64 KiB a slice, 16 slices a block, five blocks
constexpr std::uint64_t kSlice = 256 * 128 * 2;
constexpr std::uint64_t kLevel = kSlice * 80;

/// Counts what is read from it and what it is told to drop.
class Disk : public VolumeProvider {
public:
    explicit Disk(int volumes) {
        for (int i = 0; i < volumes; ++i) {
            DatasetMeta meta;
            meta.key = nameOf(i);
            meta.grid.dims = kDims;
            auto& field = meta.fields.emplace_back();
            field.name = "ramp";
            field.storedType = ScalarType::U16;
            std::vector<unsigned short> samples(static_cast<std::size_t>(sampleCount(kDims)));
            for (std::size_t s = 0; s < samples.size(); ++s)
                samples[s] = static_cast<unsigned short>(s / 7 + static_cast<std::size_t>(i) * 1000);
            std::vector<std::byte> bytes(samples.size() * 2);
            std::memcpy(bytes.data(), samples.data(), bytes.size());
            memory_.add(std::move(meta), {std::move(bytes)});
        }
    }
    static std::string nameOf(int i) { return "v" + std::to_string(i); }

    std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override {
        return memory_.describe(dataset);
    }
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override {
        if (broken) throw IoError(key.dataset, "it is shorter than it was when it was written");
        bytesRead += out.size();
        memory_.readSlices(key, zBegin, zCount, out);
    }
    MinMaxGrid readMinMax(const VolumeKey& key) const override {
        ++gridsRead;
        return memory_.readMinMax(key);
    }
    void dropPages(const VolumeKey&, int, int zCount) const override { slicesDropped += zCount; }

    mutable std::atomic<std::uint64_t> bytesRead{0};
    mutable std::atomic<int> gridsRead{0};
    mutable std::atomic<int> slicesDropped{0};
    std::atomic<bool> broken{false};

private:
    MemoryVolumeProvider memory_;
};

std::vector<std::byte> read(const VolumeProvider& volumes, const VolumeKey& key, int z, int count) {
    std::vector<std::byte> out(kSlice * static_cast<std::size_t>(count));
    volumes.readSlices(key, z, count, out);
    return out;
}

std::vector<std::byte> readLevel(const VolumeProvider& volumes, int volume) {
    return read(volumes, {Disk::nameOf(volume), 0, 0, 0}, 0, kDims.z);
}

TEST(HostVolumeCache, WhatIsReadAheadIsAtHandAndNotReadAgain) {
    const auto disk = std::make_shared<Disk>(2);
    const HostVolumeCache cache(disk, {.budgetBytes = 3 * kLevel});
    const VolumeKey key{"v0", 0, 0, 0};
    EXPECT_FALSE(cache.isAtHand(key));
    cache.readAhead(key, 0, 20, std::nullopt); // two blocks of 16 slices
    EXPECT_EQ(disk->bytesRead, 32 * kSlice);
    EXPECT_FALSE(cache.isAtHand(key));
    cache.readAhead(key, 0, kDims.z, std::nullopt);
    EXPECT_EQ(disk->bytesRead, kLevel);
    EXPECT_TRUE(cache.isAtHand(key));
    EXPECT_FALSE(cache.isAtHand({"v1", 0, 0, 0}));
    const auto gridBytes = disk->readMinMax(key).ranges.size() * sizeof(MinMaxGrid::Range);
    const auto before = cache.state();
    EXPECT_EQ(before.diskBytes, kLevel + gridBytes);
    EXPECT_EQ(readLevel(cache, 0), readLevel(*disk, 0));
    (void)cache.readMinMax(key);
    EXPECT_EQ(cache.state().diskBytes, before.diskBytes);
    EXPECT_EQ(cache.state().misses, before.misses);
    EXPECT_THROW(cache.readAhead(key, 70, 20, std::nullopt), InvalidInput);
    EXPECT_THROW((void)cache.isAtHand({"v0", 0, 0, 9}), NotFound);
}

TEST(HostVolumeCache, NothingIsReadAheadThatWouldPushOutWhatIsBeingDrawn) {
    const auto disk = std::make_shared<Disk>(1);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel - 1});
    cache.readAhead({"v0", 0, 0, 0}, 0, kDims.z, std::nullopt);
    cache.readAhead({"v0", 0, 0, 0}, 0, kDims.z, FloatTexels::Full);
    EXPECT_EQ(disk->bytesRead, 0U);
}

TEST(HostVolumeCache, BeforeAnythingIsKeptAllIsEquallyFarAway) {
    const auto disk = std::make_shared<Disk>(1);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel, .keep = false});
    EXPECT_TRUE(cache.isAtHand({"v0", 0, 0, 0}));
    cache.readAhead({"v0", 0, 0, 0}, 0, kDims.z, std::nullopt);
    cache.readAhead({"v0", 0, 0, 0}, 0, kDims.z, FloatTexels::Full);
    EXPECT_EQ(disk->bytesRead, 0U);
}

HostLevel levelOf(const VolumeProvider& volumes, int volume) {
    const auto texels = std::make_shared<HostTexels>(TexelFormat::R16, kDims, glm::bvec3(false));
    texels->setSlices(0, kDims.z, readLevel(volumes, volume));
    texels->closeBorders();
    auto grid = std::make_shared<MinMaxGrid>(volumes.readMinMax({Disk::nameOf(volume), 0, 0, 0}));
    return {texels, grid, static_cast<std::uint64_t>(volume) + 1};
}

TEST(HostVolumeCache, AKeptLevelIsAtHandAndGivenBackOnce) {
    const auto disk = std::make_shared<Disk>(2);
    const HostVolumeCache cache(disk, {.budgetBytes = 3 * kLevel});
    const VolumeKey key{"v1", 0, 0, 0};
    const HostLevel level = levelOf(*disk, 1);
    EXPECT_FALSE(cache.takeLevel(key, TexelFormat::R16));
    cache.keepLevel(key, level);
    EXPECT_EQ(cache.state().bytes, bytesOf(level));
    EXPECT_TRUE(cache.isAtHand(key));
    EXPECT_FALSE(cache.isAtHand({"v0", 0, 0, 0}));
    const auto before = disk->bytesRead.load();
    cache.readAhead(key, 0, kDims.z, std::nullopt);
    EXPECT_EQ(disk->bytesRead, before) << "it is there";
    EXPECT_FALSE(cache.takeLevel(key, TexelFormat::R16F)) << "another format is of no use";
    const auto taken = cache.takeLevel(key, TexelFormat::R16);
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->texels, level.texels) << "no copy";
    EXPECT_EQ(taken->minMax, level.minMax);
    EXPECT_EQ(taken->rangesHash, 2U);
    EXPECT_EQ(cache.state().bytes, 0U);
    EXPECT_FALSE(cache.isAtHand(key));
    EXPECT_FALSE(cache.takeLevel(key, TexelFormat::R16));
}

void expectSameTexels(const HostTexels& texels, const HostTexels& expected) {
    const auto bytes = HostTexels::bytesFor(expected.format(), expected.dims());
    ASSERT_EQ(texels.dims(), expected.dims());
    EXPECT_EQ(std::memcmp(texels.first(), expected.first(), bytes), 0);
}

TEST(HostVolumeCache, WhatIsReadAheadForRaysIsALevel) {
    const auto disk = std::make_shared<Disk>(2);
    const HostVolumeCache cache(disk, {.budgetBytes = 3 * kLevel});
    const VolumeKey key{"v1", 0, 0, 0};
    const HostLevel expected = levelOf(*disk, 1);
    const auto before = disk->bytesRead.load();
    for (int z = 0; z < kDims.z; z += 30) {
        EXPECT_FALSE(cache.takeLevel(key, TexelFormat::R16));
        EXPECT_FALSE(cache.isAtHand(key));
        cache.readAhead(key, z, std::min(30, kDims.z - z), FloatTexels::Full);
        EXPECT_LE(cache.state().bytes, bytesOf(expected));
    }
    EXPECT_TRUE(cache.isAtHand(key));
    EXPECT_EQ(disk->bytesRead - before, kLevel);
    EXPECT_EQ(cache.state().bytes, bytesOf(expected)) << "and no samples beside it";
    const auto level = cache.takeLevel(key, TexelFormat::R16);
    ASSERT_TRUE(level);
    expectSameTexels(*level->texels, *expected.texels);
    EXPECT_EQ(level->rangesHash, contentHash(*expected.minMax));
    EXPECT_EQ(cache.state().bytes, 0U);
}

TEST(HostVolumeCache, WhatIsNotYetReadAheadIsTakenAsItIs) {
    const auto disk = std::make_shared<Disk>(2);
    const HostVolumeCache cache(disk, {.budgetBytes = 3 * kLevel});
    const VolumeKey key{"v1", 0, 0, 0};
    cache.readAhead(key, 0, 16, FloatTexels::Full);
    cache.readAhead(key, 16, 5, FloatTexels::Full);
    EXPECT_GT(cache.state().bytes, kLevel) << "counted whole from the start";
    EXPECT_FALSE(cache.takeUnfinished({"v0", 0, 0, 0}, TexelFormat::R16));
    EXPECT_FALSE(cache.takeUnfinished(key, TexelFormat::R8));
    const auto begun = cache.takeUnfinished(key, TexelFormat::R16);
    ASSERT_TRUE(begun);
    EXPECT_EQ(begun->slices, 21);
    EXPECT_EQ(cache.state().bytes, 0U);
    EXPECT_FALSE(cache.takeUnfinished(key, TexelFormat::R16));
    const auto read = disk->bytesRead.load();
    cache.readAhead(key, 21, 16, FloatTexels::Full); // there is nothing it could go on with
    EXPECT_EQ(disk->bytesRead, read);
    // Whoever took it goes on by himself.
    begun->texels->setSlices(21, kDims.z - 21, ::voxsheet::read(cache, key, 21, kDims.z - 21));
    begun->texels->closeBorders();
    expectSameTexels(*begun->texels, *levelOf(*disk, 1).texels);
}

TEST(HostVolumeCache, WhatIsReadAheadForRaysGoesWhenOthersNeedTheRoom) {
    const auto disk = std::make_shared<Disk>(3);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel + kLevel / 2});
    cache.readAhead({"v0", 0, 0, 0}, 0, 16, FloatTexels::Full);
    cache.readAhead({"v1", 0, 0, 0}, 0, 16, FloatTexels::Full);
    EXPECT_EQ(cache.takeUnfinished({"v0", 0, 0, 0}, TexelFormat::R16)->slices, 16) << "both are there";
    cache.keepLevel({"v0", 0, 0, 0}, levelOf(*disk, 0));
    cache.keepLevel({"v2", 0, 0, 0}, levelOf(*disk, 2));
    EXPECT_LE(cache.state().bytes, cache.state().budgetBytes);
    const auto read = disk->bytesRead.load();
    cache.readAhead({"v1", 0, 0, 0}, 16, 16, FloatTexels::Full);
    EXPECT_EQ(disk->bytesRead, read);
    EXPECT_FALSE(cache.takeUnfinished({"v1", 0, 0, 0}, TexelFormat::R16));
}

TEST(HostVolumeCache, WhatIsReadOnceIsNotKept) {
    const auto disk = std::make_shared<Disk>(1);
    const HostVolumeCache cache(disk, {.budgetBytes = 3 * kLevel, .pageCache = PageCacheUse::DropAlways});
    const VolumeKey key{"v0", 0, 0, 0};
    (void)read(cache, key, 0, 16); // a block
    const auto expected = readLevel(*disk, 0);
    const auto before = disk->bytesRead.load();
    std::vector<std::byte> out(kLevel);
    cache.readSlicesOnce(key, 0, kDims.z, out);
    EXPECT_EQ(out, expected);
    EXPECT_EQ(disk->bytesRead - before, kLevel - 16 * kSlice) << "what is kept is of use";
    EXPECT_EQ(cache.state().bytes, 16 * kSlice);
    EXPECT_EQ(disk->slicesDropped, kDims.z);
}

/// The memory of the level that has to go for it is used again, unless somebody looks at it still.
TEST(HostVolumeCache, WhatIsReadAheadTakesThePlaceOfWhatGoes) {
    const auto disk = std::make_shared<Disk>(3);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel + kLevel / 2});
    HostLevel going = levelOf(*disk, 0);
    const HostTexels* place = going.texels.get();
    cache.keepLevel({"v0", 0, 0, 0}, std::exchange(going, {}));
    cache.keepLevel({"v1", 0, 0, 0}, levelOf(*disk, 1));
    cache.readAhead({"v2", 0, 0, 0}, 0, kDims.z, FloatTexels::Full);
    EXPECT_FALSE(cache.isAtHand({"v0", 0, 0, 0}));
    const auto second = cache.takeLevel({"v2", 0, 0, 0}, TexelFormat::R16);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->texels.get(), place);
    expectSameTexels(*second->texels, *levelOf(*disk, 2).texels);
    const HostLevel looked = levelOf(*disk, 0);
    cache.keepLevel({"v0", 0, 0, 0}, looked);
    cache.readAhead({"v2", 0, 0, 0}, 0, kDims.z, FloatTexels::Full); // v1 goes
    cache.readAhead({"v1", 0, 0, 0}, 0, kDims.z, FloatTexels::Full); // v0 goes
    EXPECT_FALSE(cache.isAtHand({"v0", 0, 0, 0}));
    expectSameTexels(*looked.texels, *levelOf(*disk, 0).texels);
    expectSameTexels(*second->texels, *levelOf(*disk, 2).texels);
    EXPECT_LE(cache.state().bytes, cache.state().budgetBytes);
}

TEST(HostVolumeCache, WhatIsAwaitedGoesLast) {
    const auto disk = std::make_shared<Disk>(4);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel + kLevel / 2});
    const VolumeKey a{"v0", 0, 0, 0}, b{"v1", 0, 0, 0}, c{"v2", 0, 0, 0}, d{"v3", 0, 0, 0};
    cache.setAwaited({a, d});
    cache.keepLevel(a, levelOf(*disk, 0));
    cache.keepLevel(b, levelOf(*disk, 1));
    cache.keepLevel(c, levelOf(*disk, 2));
    EXPECT_TRUE(cache.isAtHand(a)) << "although it is the oldest";
    EXPECT_FALSE(cache.isAtHand(b));
    cache.readAhead(d, 0, kDims.z, FloatTexels::Full);
    EXPECT_FALSE(cache.isAtHand(c));
    cache.keepLevel(c, levelOf(*disk, 2)); // who keeps a level must have the room
    EXPECT_LE(cache.state().bytes, cache.state().budgetBytes);
    EXPECT_FALSE(cache.isAtHand(a));
    EXPECT_TRUE(cache.isAtHand(d));
    cache.setAwaited({});
    cache.keepLevel(a, levelOf(*disk, 0));
    EXPECT_FALSE(cache.isAtHand(c)) << "by age again: what was awaited until now is the newest";
    EXPECT_TRUE(cache.isAtHand(d));
}

TEST(HostVolumeCache, NothingIsReadAheadInPlaceOfWhatIsAwaited) {
    const auto disk = std::make_shared<Disk>(3);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel + kLevel / 2});
    const VolumeKey a{"v0", 0, 0, 0}, b{"v1", 0, 0, 0}, c{"v2", 0, 0, 0};
    cache.keepLevel(a, levelOf(*disk, 0));
    cache.keepLevel(b, levelOf(*disk, 1));
    cache.setAwaited({a, b, c});
    auto before = disk->bytesRead.load();
    cache.readAhead(c, 0, kDims.z, FloatTexels::Full);
    cache.readAhead(c, 0, kDims.z, std::nullopt);
    EXPECT_LT(disk->bytesRead, before + kLevel / 2) << "blocks, as far as there is room";
    EXPECT_TRUE(cache.isAtHand(a));
    EXPECT_TRUE(cache.isAtHand(b));
    before = disk->bytesRead;
    cache.endAwaited(b);
    cache.readAhead(c, 0, kDims.z, FloatTexels::Full);
    EXPECT_EQ(disk->bytesRead, before + kLevel);
    EXPECT_TRUE(cache.isAtHand(a));
    EXPECT_FALSE(cache.isAtHand(b));
    EXPECT_TRUE(cache.isAtHand(c));
}

TEST(HostVolumeCache, KeptLevelsAndBlocksShareTheBudget) {
    const auto disk = std::make_shared<Disk>(3);
    HostVolumeCache cache(
        disk, {.budgetBytes = 2 * kLevel + kLevel / 2, .pageCache = PageCacheUse::DropOverBudget});
    cache.keepLevel({"v0", 0, 0, 0}, levelOf(*disk, 0));
    cache.keepLevel({"v0", 0, 0, 0}, levelOf(*disk, 0)); // takes its place
    (void)readLevel(cache, 1);
    EXPECT_TRUE(cache.isAtHand({"v0", 0, 0, 0}));
    EXPECT_EQ(cache.state().bytes, bytesOf(levelOf(*disk, 0)) + kLevel);
    EXPECT_EQ(disk->slicesDropped, 0);
    cache.keepLevel({"v2", 0, 0, 0}, levelOf(*disk, 2));
    EXPECT_FALSE(cache.isAtHand({"v0", 0, 0, 0})) << "the least recently used went";
    EXPECT_EQ(disk->slicesDropped, kDims.z) << "and its pages";
    EXPECT_LE(cache.state().bytes, cache.state().budgetBytes);
    cache.forget("v1");
    EXPECT_EQ(cache.state().bytes, bytesOf(levelOf(*disk, 2)));
    cache.forget("v2");
    EXPECT_EQ(cache.state().bytes, 0U);
    EXPECT_EQ(disk->slicesDropped, kDims.z);
}

TEST(HostVolumeCache, ALevelLargerThanTheBudgetIsNotKept) {
    const auto disk = std::make_shared<Disk>(1);
    const HostVolumeCache cache(disk, {.budgetBytes = kLevel, .pageCache = PageCacheUse::DropOverBudget});
    cache.keepLevel({"v0", 0, 0, 0}, levelOf(*disk, 0)); // its border makes it larger
    EXPECT_EQ(cache.state().bytes, 0U);
    EXPECT_FALSE(cache.takeLevel({"v0", 0, 0, 0}, TexelFormat::R16));
    EXPECT_EQ(disk->slicesDropped, kDims.z);
}

TEST(HostVolumeCache, ReadsFromDiskOnce) {
    const auto disk = std::make_shared<Disk>(1);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel});
    const VolumeKey key{"v0", 0, 0, 0};
    for (const auto& [z, count] : {std::pair(0, 80), {3, 1}, {15, 2}, {79, 1}, {10, 40}})
        EXPECT_EQ(read(cache, key, z, count), read(*disk, key, z, count)) << z << " + " << count;
    EXPECT_EQ(cache.state().diskBytes, kLevel);
    EXPECT_EQ(cache.state().bytes, kLevel);
    EXPECT_EQ(cache.state().misses, 5U);
    EXPECT_EQ(cache.state().hits, 1U + 2U + 1U + 4U);
    const auto grid = cache.readMinMax(key);
    EXPECT_EQ(cache.readMinMax(key).ranges.size(), grid.ranges.size());
    EXPECT_EQ(disk->gridsRead, 1);
    EXPECT_EQ(cache.state().bytes, kLevel + grid.ranges.size() * sizeof(MinMaxGrid::Range));
    EXPECT_GE(cache.state().diskMs, 0.0);
}

TEST(HostVolumeCache, WhatIsOverTheBudgetIsReadAgain) {
    const auto disk = std::make_shared<Disk>(3);
    HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel});
    for (int round = 0; round < 2; ++round)
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(readLevel(cache, i), readLevel(*disk, i));
            EXPECT_LE(cache.state().bytes, 2 * kLevel);
        }
    EXPECT_EQ(cache.state().diskBytes, 6 * kLevel) << "the paper's second transition: each time from disk";
    EXPECT_GT(cache.state().evictions, 0U);
    const auto before = cache.state().diskBytes;
    (void)readLevel(cache, 2);
    EXPECT_EQ(cache.state().diskBytes, before) << "the last two are there";
    cache.forget("v2");
    EXPECT_EQ(cache.state().bytes, kLevel);
    (void)readLevel(cache, 2);
    EXPECT_EQ(cache.state().diskBytes, before + kLevel);
}

TEST(HostVolumeCache, ALevelLargerThanTheBudgetGoesThroughWithoutBeingHeld) {
    const auto disk = std::make_shared<Disk>(2);
    HostVolumeCache cache(disk, {.budgetBytes = kLevel - 1});
    EXPECT_EQ(readLevel(cache, 0), readLevel(*disk, 0));
    EXPECT_EQ(cache.state().bytes, 0U);
    EXPECT_EQ(cache.state().diskBytes, kLevel);
    // Its pyramid is small enough.
    std::vector<std::byte> coarse(static_cast<std::size_t>(sampleCount(levelDims(kDims, 1))) * 2);
    cache.readSlices({"v0", 0, 0, 1}, 0, levelDims(kDims, 1).z, coarse);
    cache.readSlices({"v0", 0, 0, 1}, 0, levelDims(kDims, 1).z, coarse);
    EXPECT_EQ(cache.state().bytes, coarse.size());
    EXPECT_EQ(cache.state().diskBytes, kLevel + coarse.size());
}

TEST(HostVolumeCache, KeepsNothingUntilItIsOfUse) {
    const auto disk = std::make_shared<Disk>(1);
    HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel, .keep = false});
    (void)readLevel(cache, 0);
    EXPECT_EQ(cache.state().bytes, 0U);
    cache.keepFromNowOn();
    (void)readLevel(cache, 0);
    EXPECT_EQ(cache.state().bytes, kLevel);
}

TEST(HostVolumeCache, DropsPagesWhenAskedTo) {
    const auto dropped = [](PageCacheUse use, std::uint64_t budget, int levels) {
        const auto disk = std::make_shared<Disk>(3);
        const HostVolumeCache cache(disk, {.budgetBytes = budget, .pageCache = use});
        for (int i = 0; i < levels; ++i)
            (void)readLevel(cache, i);
        return disk->slicesDropped.load();
    };
    EXPECT_EQ(dropped(PageCacheUse::Keep, kLevel, 3), 0);
    EXPECT_EQ(dropped(PageCacheUse::DropAlways, 2 * kLevel, 2), 2 * 80);
    EXPECT_EQ(dropped(PageCacheUse::DropOverBudget, 2 * kLevel, 2), 0) << "within the budget";
    EXPECT_EQ(dropped(PageCacheUse::DropOverBudget, 2 * kLevel, 3), 80) << "of what was evicted";
    EXPECT_EQ(dropped(PageCacheUse::DropOverBudget, kLevel / 2, 1), 80) << "of what is not kept";
}

TEST(HostVolumeCache, AFailedReadLeavesNothingBehind) {
    const auto disk = std::make_shared<Disk>(1);
    const HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel});
    disk->broken = true;
    EXPECT_THROW((void)readLevel(cache, 0), IoError);
    EXPECT_EQ(cache.state().bytes, 0U);
    disk->broken = false;
    EXPECT_EQ(readLevel(cache, 0), readLevel(*disk, 0));
    std::vector<std::byte> wrong(10);
    EXPECT_THROW(cache.readSlices({"v0", 0, 0, 0}, 0, 1, wrong), InvalidInput);
    EXPECT_THROW(cache.readSlices({"v0", 0, 0, 0}, 79, 2, wrong), InvalidInput);
    EXPECT_THROW(cache.readSlices({"v0", 0, 0, 9}, 0, 1, wrong), NotFound);
    EXPECT_THROW((void)cache.describe("nobody"), NotFound);
}

TEST(HostVolumeCache, ThreadsReadTheSameBytesWithinTheBudget) {
    const auto disk = std::make_shared<Disk>(4);
    HostVolumeCache cache(disk, {.budgetBytes = 2 * kLevel, .pageCache = PageCacheUse::DropOverBudget});
    std::vector<std::vector<std::byte>> expected;
    for (int i = 0; i < 4; ++i)
        expected.push_back(readLevel(*disk, i));
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            std::mt19937 random(t);
            for (int step = 0; step < 150; ++step) {
                const auto volume = static_cast<int>(random() % 4);
                const auto z = static_cast<int>(random() % 80);
                const auto count = 1 + static_cast<int>(random() % static_cast<unsigned>(80 - z));
                const auto got = read(cache, {Disk::nameOf(volume), 0, 0, 0}, z, count);
                const auto* want =
                    expected[static_cast<std::size_t>(volume)].data() + static_cast<std::size_t>(z) * kSlice;
                if (std::memcmp(got.data(), want, got.size()) != 0) ++wrong;
                if (cache.state().bytes > 2 * kLevel) ++wrong;
                if (step % 50 == 49) cache.forget(Disk::nameOf(volume));
            }
        });
    }
    for (auto& thread : threads)
        thread.join();
    EXPECT_EQ(wrong, 0);
    for (int i = 0; i < 4; ++i)
        cache.forget(Disk::nameOf(i));
    EXPECT_EQ(cache.state().bytes, 0U) << "the sum over what is kept";
}

} // namespace
} // namespace voxsheet
