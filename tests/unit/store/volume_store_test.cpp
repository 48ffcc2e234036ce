#include "base/errors.h"
#include "base/huge_page_block.h"
#include "store/meta_json.h"
#include "store/store_key.h"
#include "store/store_volume_provider.h"
#include "store_fixture.h"
#include "volume/memory_volume_provider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace voxsheet::store {
namespace {

namespace fs = std::filesystem;

class StoreTest : public ::testing::Test {
protected:
    [[nodiscard]] fs::path folder() const { return temporary_.path() / "store"; }
    [[nodiscard]] std::size_t namesInStore() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder()), fs::directory_iterator()));
    }
    void setLastUse(const std::string& key, long seconds) const {
        const std::array<struct timespec, 2> times{{{seconds, 0}, {seconds, 0}}};
        ASSERT_EQ(::utimensat(AT_FDCWD, (folder() / key / kLockFile).c_str(), times.data(), 0), 0);
    }

private:
    TemporaryFolder temporary_;
};

/// Pages of the file that the operating system holds in its cache.
std::size_t cachedPages(const fs::path& file) {
    const auto bytes = fs::file_size(file);
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const FileHandle handle(file, O_RDONLY);
    void* mapped = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, handle.descriptor(), 0);
    if (mapped == MAP_FAILED) return 0;
    std::vector<unsigned char> in((bytes + page - 1) / page);
    ::mincore(mapped, bytes, in.data());
    ::munmap(mapped, bytes);
    return static_cast<std::size_t>(
        std::count_if(in.begin(), in.end(), [](auto p) { return (p & 1U) != 0; }));
}

/// A volume of 2 MiB in a store, and its samples as they are read from it.
class StoredRamp {
public:
    explicit StoredRamp(const fs::path& folder)
        : volumes(stored(folder)), file(folder / key.dataset / arrayFileName(0, 0)) {
        volumes.readSlices(key, 0, dims.z, samples);
    }

    const glm::ivec3 dims{256, 256, 16};
    const VolumeKey key{"abc", 0, 0, 0};
    const StoreVolumeProvider volumes;
    const fs::path file;
    std::vector<std::byte> samples = std::vector<std::byte>(std::size_t{256} * 256 * 16 * 2);

private:
    [[nodiscard]] std::shared_ptr<VolumeStore> stored(const fs::path& folder) const {
        auto store = std::make_shared<VolumeStore>(folder);
        StoreWriter writer(*store, sampleMeta(key.dataset, dims));
        writer.addArray(0, 0, rampSamples(dims));
        writer.commit();
        return store;
    }
};

TEST_F(StoreTest, DropsThePagesOfSlicesThatAreNotWantedSoon) {
    const StoredRamp ramp(folder());
    const auto before = cachedPages(ramp.file);
    ASSERT_GT(before, 500U);
    // In pieces, as they are read; what was just written may be held in larger ones.
    for (int z = 0; z < ramp.dims.z; z += 4)
        ramp.volumes.dropPages(ramp.key, z, 4);
    const auto after = cachedPages(ramp.file);
    if (after == before) GTEST_SKIP() << "this file system takes no advice about its cache";
    EXPECT_LE(after, before - 512) << "2 MiB in pages of 4 KiB";
    auto again = ramp.samples;
    ramp.volumes.readSlices(ramp.key, 0, ramp.dims.z, again);
    EXPECT_EQ(again, ramp.samples);
}

TEST_F(StoreTest, GivesTheSameSamplesPastTheSystemsCache) {
    const StoredRamp ramp(folder());
    const auto& samples = ramp.samples;
    const auto readOnce = [&](std::span<std::byte> out) {
        ramp.volumes.readSlicesOnce(ramp.key, 0, ramp.dims.z, out);
        return std::equal(samples.begin(), samples.end(), out.begin());
    };
    ramp.volumes.dropPages(ramp.key, 0, ramp.dims.z);
    const auto before = cachedPages(ramp.file);
    HugePageBlock block(samples.size() + 64);
    const std::span<std::byte> aligned(block.data(), samples.size());
    const std::span<std::byte> between(block.data() + 64, samples.size());
    EXPECT_TRUE(readOnce(aligned));
    const auto after = cachedPages(ramp.file);
    EXPECT_TRUE(readOnce(between));
    fs::resize_file(ramp.file, samples.size() - 4096);
    EXPECT_THROW((void)readOnce(aligned), IoError) << "shorter than it was";
    const int direct = ::open(ramp.file.c_str(), O_RDONLY | O_DIRECT);
    if (direct < 0) GTEST_SKIP() << "this file system reads nothing past its cache";
    ::close(direct);
    EXPECT_LE(after, before);
}

TEST_F(StoreTest, GivesWhatTheMemoryProviderGives) {
    const glm::ivec3 dims(37, 20, 18);
    auto store = std::make_shared<VolumeStore>(folder());
    MemoryVolumeProvider memory;
    auto meta = sampleMeta("abc", dims, 2, 2);
    meta.grid.periodic = {true, true, true};
    std::vector<std::vector<std::byte>> arrays;
    StoreWriter writer(*store, meta);
    for (int f = 0; f < 2; ++f)
        for (int s = 0; s < 2; ++s) {
            arrays.push_back(rampSamples(dims, 100 * f + 7 * s));
            writer.addArray(f, s, rampSamples(dims, 100 * f + 7 * s));
        }
    EXPECT_EQ(store->open("abc"), nullptr) << "an entry must not be seen before it is whole";
    writer.commit();
    memory.add(meta, std::move(arrays));

    const StoreVolumeProvider volumes(store);
    const auto described = volumes.describe("abc");
    EXPECT_EQ(metaToJson(*described), metaToJson(*memory.describe("abc")));
    EXPECT_EQ(described->key, "abc");
    for (int f = 0; f < 2; ++f)
        for (int s = 0; s < 2; ++s)
            for (int l = 0; l < described->levels(); ++l) {
                const VolumeKey key{"abc", f, s, l};
                const auto z = levelDims(dims, l).z;
                std::vector<std::byte> expected(sliceBytes(*described, key, 1, z - 1).count);
                std::vector<std::byte> got(expected.size());
                memory.readSlices(key, 1, z - 1, expected);
                volumes.readSlices(key, 1, z - 1, got);
                EXPECT_EQ(got, expected);
                const auto a = memory.readMinMax(key);
                const auto b = volumes.readMinMax(key);
                ASSERT_EQ(a.bricks, b.bricks);
                for (std::size_t i = 0; i < a.ranges.size(); ++i) {
                    EXPECT_EQ(a.ranges[i].low, b.ranges[i].low);
                    EXPECT_EQ(a.ranges[i].high, b.ranges[i].high);
                }
            }
}

TEST_F(StoreTest, ProbesGiveSourceValues) {
    const glm::ivec3 dims(20, 9, 6);
    auto store = std::make_shared<VolumeStore>(folder());
    writeSample(*store, "abc", dims);
    const StoreVolumeProvider volumes(store);
    const auto at = [&](int x, int y, int z) { return 0.5 * ((z * 9 + y) * 20 + x) - 1.0; };
    EXPECT_EQ(volumes.readValue("abc", 0, 0, {3, 2, 1}), at(3, 2, 1));
    EXPECT_EQ(volumes.readValue("abc", 0, 0, {19, 8, 5}), at(19, 8, 5));
    EXPECT_THROW((void)volumes.readValue("abc", 0, 0, {20, 0, 0}), InvalidInput);
    EXPECT_THROW((void)volumes.readValue("abc", 0, 0, {0, -1, 0}), InvalidInput);
    for (const glm::ivec3 size : {glm::ivec3(2, 3, 4), glm::ivec3(20, 3, 2)}) {
        const glm::ivec3 low(size.x == 20 ? 0 : 5, 2, 1);
        std::vector<double> box(static_cast<std::size_t>(sampleCount(size)));
        volumes.entry("abc")->readBox({"abc", 0, 0, 0}, low, size, box);
        std::size_t i = 0;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    EXPECT_EQ(box[i++], at(low.x + x, low.y + y, low.z + z));
    }
}

TEST_F(StoreTest, NothingIsLeftWithoutCommit) {
    const VolumeStore store(folder());
    {
        StoreWriter writer(store, sampleMeta("abc"));
        writer.addArray(0, 0, rampSamples({20, 9, 6}));
        EXPECT_EQ(namesInStore(), 1U);
    }
    EXPECT_EQ(namesInStore(), 0U);
    EXPECT_EQ(store.open("abc"), nullptr);
}

TEST_F(StoreTest, WriterRefusesWhatDoesNotFit) {
    const VolumeStore store(folder());
    EXPECT_THROW(StoreWriter(store, sampleMeta("../evil")), InvalidInput);
    EXPECT_THROW((void)store.open("../evil"), InvalidInput);
    StoreWriter writer(store, sampleMeta("abc", {20, 9, 6}, 1, 2));
    EXPECT_THROW(writer.addArray(0, 0, rampSamples({20, 9, 5})), InvalidInput);
    EXPECT_THROW(writer.addArray(1, 0, rampSamples({20, 9, 6})), NotFound);
    writer.addArray(0, 0, rampSamples({20, 9, 6}));
    EXPECT_THROW(writer.addArray(0, 0, rampSamples({20, 9, 6})), InvalidInput);
    EXPECT_THROW(writer.commit(), InvalidInput) << "step 1 is missing";
    EXPECT_EQ(store.open("abc"), nullptr);
}

TEST_F(StoreTest, DamagedEntriesCountAsAbsentAndGo) {
    const VolumeStore store(folder());
    const auto damageAndOpen = [&](const auto& damage) {
        writeSample(store, "abc");
        EXPECT_NE(store.open("abc"), nullptr);
        damage();
        EXPECT_EQ(store.open("abc"), nullptr);
        EXPECT_FALSE(fs::exists(folder() / "abc"));
    };
    const auto array = folder() / "abc" / arrayFileName(0, 0);
    const auto meta = folder() / "abc" / kMetaFile;
    const auto size = (writeSample(store, "abc"), fs::file_size(array));
    const auto metaSize = fs::file_size(meta);
    for (const auto cut : {std::uintmax_t(0), std::uintmax_t(1), size / 2, size - 1})
        damageAndOpen([&] { fs::resize_file(array, cut); });
    damageAndOpen([&] { fs::resize_file(array, size + 1); });
    damageAndOpen([&] { fs::remove(array); });
    damageAndOpen([&] { fs::remove(meta); });
    damageAndOpen([&] { fs::remove(folder() / "abc" / kLockFile); });
    for (std::uintmax_t cut = 0; cut < metaSize; cut += metaSize / 16)
        damageAndOpen([&] { fs::resize_file(meta, cut); });
    damageAndOpen([&] { std::ofstream(meta) << std::string(100000, '['); });
    damageAndOpen([&] { std::ofstream(meta) << R"({"voxsheet_store_entry":999,"dataset":{}})"; });
    writeSample(store, "abc");
    EXPECT_NE(store.open("abc"), nullptr) << "made again from its source";
}

TEST_F(StoreTest, TruncationWhileOpenIsAnErrorAndNotACrash) {
    const VolumeStore store(folder());
    writeSample(store, "abc");
    const auto entry = store.open("abc");
    fs::resize_file(folder() / "abc" / arrayFileName(0, 0), 10);
    std::vector<std::byte> slice(20 * 9 * 2);
    EXPECT_THROW(entry->readSlices({"abc", 0, 0, 0}, 0, 1, slice), IoError);
    fs::remove_all(folder() / "abc");
    EXPECT_THROW(entry->readSlices({"abc", 0, 0, 0}, 0, 1, slice), IoError);
    EXPECT_THROW((void)entry->readMinMax({"abc", 0, 0, 0}), IoError);
}

TEST_F(StoreTest, LeastRecentlyUsedGoFirstAndOpenOnesStay) {
    const auto one = [&] {
        const VolumeStore unlimited(folder());
        for (const auto* key : {"a", "b", "c"})
            writeSample(unlimited, key);
        return unlimited.usedBytes() / 3;
    }();
    setLastUse("a", 3000);
    setLastUse("b", 1000);
    setLastUse("c", 2000);
    const VolumeStore limited(folder(), one * 3 + one / 2);
    const auto held = StoreVolumeProvider(std::make_shared<VolumeStore>(folder())).entry("b");
    setLastUse("b", 1000);
    writeSample(limited, "d");
    EXPECT_TRUE(fs::exists(folder() / "b")) << "open, though it was used longest ago";
    EXPECT_FALSE(fs::exists(folder() / "c"));
    EXPECT_TRUE(fs::exists(folder() / "a"));
    EXPECT_TRUE(fs::exists(folder() / "d"));
    EXPECT_LE(limited.usedBytes(), limited.limitBytes());
}

TEST_F(StoreTest, UseIsRemembered) {
    const VolumeStore store(folder());
    writeSample(store, "a");
    setLastUse("a", 1000);
    (void)store.open("a");
    struct stat info {};
    ASSERT_EQ(::stat((folder() / "a" / kLockFile).c_str(), &info), 0);
    EXPECT_GT(info.st_mtim.tv_sec, 1000000);
}

TEST_F(StoreTest, AnEntryLargerThanTheLimitStillWorks) {
    const VolumeStore store(folder(), 10);
    writeSample(store, "a");
    EXPECT_NE(store.open("a"), nullptr);
    writeSample(store, "b");
    EXPECT_EQ(store.open("a"), nullptr);
    EXPECT_NE(store.open("b"), nullptr);
}

TEST_F(StoreTest, ProcessKilledBetweenWriteAndRenameLeavesNothing) {
    { const VolumeStore make(folder()); }
    const auto child = ::fork();
    if (child == 0) {
        const VolumeStore store(folder());
        StoreWriter writer(store, sampleMeta("abc"));
        writer.addArray(0, 0, rampSamples({20, 9, 6}));
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(namesInStore(), 1U) << "what the killed writer left behind";
    const VolumeStore again(folder());
    EXPECT_EQ(namesInStore(), 0U);
    EXPECT_EQ(again.open("abc"), nullptr);
}

TEST_F(StoreTest, WhatIsReadEarlyIsInvisibleToOthersAndGoneWithAKilledWriter) {
    { const VolumeStore make(folder()); }
    const auto child = ::fork();
    if (child == 0) {
        const VolumeStore store(folder());
        StoreWriter writer(store, sampleMeta("abc"));
        writer.addArray(0, 0, rampSamples({20, 9, 6}));
        const auto early = writer.entry();
        const bool whole = early && early->meta()->key == "abc" && !store.open("abc");
        if (whole) ::kill(::getpid(), SIGKILL);
        ::_exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "readable early, and by nobody else";
    const VolumeStore again(folder());
    EXPECT_EQ(namesInStore(), 0U);
    EXPECT_EQ(again.open("abc"), nullptr);
}

TEST_F(StoreTest, AnEntryReadEarlyOutlivesRenamingAndAnotherWriter) {
    const VolumeStore store(folder());
    std::vector<std::byte> slice(20 * 9 * 2);
    const auto reads = [&](const StoreEntry& entry) { entry.readSlices({"abc", 0, 0, 0}, 0, 1, slice); };
    std::shared_ptr<const StoreEntry> early;
    std::shared_ptr<const StoreEntry> late;
    {
        StoreWriter first(store, sampleMeta("abc"));
        StoreWriter second(store, sampleMeta("abc"));
        first.addArray(0, 0, rampSamples({20, 9, 6}));
        second.addArray(0, 0, rampSamples({20, 9, 6}));
        early = first.entry();
        late = second.entry();
        EXPECT_TRUE(first.commit());
        EXPECT_FALSE(second.commit());
    }
    EXPECT_NO_THROW(reads(*early));
    EXPECT_NO_THROW(reads(*late)) << "its folder went before its reader";
    EXPECT_FALSE(store.remove("abc")) << "it is open";
    early.reset();
    late.reset();
    EXPECT_EQ(namesInStore(), 1U) << "the second one's folder stays behind";
    EXPECT_TRUE(store.remove("abc"));
}

TEST_F(StoreTest, ALiveWritersFolderIsLeftAlone) {
    const VolumeStore store(folder());
    StoreWriter writer(store, sampleMeta("abc"));
    writer.addArray(0, 0, rampSamples({20, 9, 6}));
    { const VolumeStore other(folder()); }
    writer.commit();
    EXPECT_NE(store.open("abc"), nullptr);
}

/// Every importer that starts tidies the store: never what another one is about to write into.
TEST_F(StoreTest, TidyingNeverTakesAFolderThatIsJustBeingMade) {
    const VolumeStore store(folder());
    std::atomic<bool> done{false};
    std::vector<std::thread> tidiers;
    for (int i = 0; i < 4; ++i)
        tidiers.emplace_back([&] {
            while (!done)
                (void)VolumeStore(folder());
        });
    EXPECT_NO_THROW({
        for (int i = 0; i < 300; ++i) {
            StoreWriter writer(store, sampleMeta("k" + std::to_string(i)));
            writer.addArray(0, 0, rampSamples({20, 9, 6}));
        }
    });
    done = true;
    for (auto& tidier : tidiers)
        tidier.join();
}

TEST_F(StoreTest, TheFirstOfTwoEqualWritersWins) {
    const VolumeStore store(folder());
    StoreWriter first(store, sampleMeta("abc"));
    StoreWriter second(store, sampleMeta("abc"));
    first.addArray(0, 0, rampSamples({20, 9, 6}));
    second.addArray(0, 0, rampSamples({20, 9, 6}));
    first.commit();
    const auto entry = store.open("abc");
    second.commit();
    std::vector<std::byte> slice(20 * 9 * 2);
    EXPECT_NO_THROW(entry->readSlices({"abc", 0, 0, 0}, 0, 1, slice)) << "replaced under a reader";
}

TEST_F(StoreTest, ADamagedEntryInTheWayIsReplaced) {
    const VolumeStore store(folder());
    writeSample(store, "abc");
    fs::resize_file(folder() / "abc" / arrayFileName(0, 0), 3);
    writeSample(store, "abc");
    EXPECT_NE(store.open("abc"), nullptr);
}

/// Whoever removes an entry holds its lock, and may have to wait for a processor meanwhile.
TEST_F(StoreTest, AWriterWaitsForAnEntryThatIsBeingRemoved) {
    const VolumeStore store(folder());
    writeSample(store, "abc");
    FileHandle held(folder() / "abc" / kLockFile, O_RDWR);
    ASSERT_TRUE(held.tryLock(true));
    const std::jthread remover([&, lock = std::move(held)]() mutable {
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        fs::rename(folder() / "abc", folder() / ".trash-abc");
        lock = {};
    });
    EXPECT_NO_THROW(writeSample(store, "abc"));
    EXPECT_NE(store.open("abc"), nullptr);
}

TEST_F(StoreTest, ManyWritersReadersAndAnEvictorAgree) {
    const auto one = [&] {
        const VolumeStore store(folder());
        writeSample(store, "k0");
        return store.usedBytes();
    }();
    const VolumeStore store(folder(), one * 3);
    std::atomic<int> failures{0};
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            try {
                for (int i = 0; i < 25; ++i) {
                    const auto key = "k" + std::to_string((i * 7 + t) % 5);
                    writeSample(store, key);
                    if (const auto entry = store.open(key)) {
                        std::vector<std::byte> slice(20 * 9 * 2);
                        entry->readSlices({key, 0, 0, 0}, 5, 1, slice);
                    }
                }
            } catch (const std::exception& error) {
                ++failures;
                ADD_FAILURE() << error.what();
            }
        });
    threads.clear();
    EXPECT_EQ(failures.load(), 0);
    store.makeRoom(0);
    EXPECT_LE(store.usedBytes(), store.limitBytes());
}

TEST(StoreKey, DependsOnEverythingThatDecidesTheBytes) {
    const std::vector<FileStamp> files{{"/a", 10, 5}};
    const auto key = importKey(files, "1", "{}");
    EXPECT_EQ(key.size(), 32U);
    EXPECT_TRUE(isStoreKey(key));
    EXPECT_EQ(importKey(files, "1", "{}"), key);
    EXPECT_NE(importKey(files, "2", "{}"), key);
    EXPECT_NE(importKey(files, "1", "{\"flip\":1}"), key);
    EXPECT_NE(importKey(std::vector<FileStamp>{{"/b", 10, 5}}, "1", "{}"), key);
    EXPECT_NE(importKey(std::vector<FileStamp>{{"/a", 11, 5}}, "1", "{}"), key);
    EXPECT_NE(importKey(std::vector<FileStamp>{{"/a", 10, 6}}, "1", "{}"), key);
    EXPECT_NE(importKey(std::vector<FileStamp>{{"/a", 10, 5}, {"/b", 1, 1}}, "1", "{}"), key);
    EXPECT_NE(storeKey(std::vector<std::string>{"ab", "c"}), storeKey(std::vector<std::string>{"a", "bc"}));
    EXPECT_NE(formulaKey("A-B", std::vector<std::string>{"x", "y"}),
              formulaKey("A-B", std::vector<std::string>{"y", "x"}));
    for (const auto* bad : {"", ".", "..", "a/b", "A", "a.b", "a b"})
        EXPECT_FALSE(isStoreKey(bad)) << bad;
    EXPECT_FALSE(isStoreKey(std::string(65, 'a')));
}

TEST(StoreKey, StampsNameAbsentFiles) { EXPECT_THROW((void)stampOf("/no/such/file"), NotFound); }

TEST(VolumeStoreFolder, ThatCannotBeMadeIsOneSentence) {
    EXPECT_THROW(VolumeStore("/proc/voxsheet"), IoError);
}

} // namespace
} // namespace voxsheet::store
