// What frames show while volumes are brought in, and when the budget does not hold them.
#include "frame/render_thread.h"

#include "base/errors.h"
#include "gl_fixture.h"
#include "residency/host_volume_cache.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

namespace voxsheet {
namespace {

constexpr int kDim = 64;
constexpr int kPixels = 64;
constexpr std::uint64_t kBytes = std::uint64_t{kDim} * kDim * kDim * 4;
constexpr int kVolumes = 6;

std::string nameOf(int i) { return "v" + std::to_string(i); }

/// Levels of a volume that is slow to read, so that uploads take many slices.
class SlowProvider : public MemoryVolumeProvider {
public:
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override {
        if (key.dataset == blocked) gate.wait(false);
        if (failing || (failingLevel0 && key.level == 0))
            throw IoError("the disk", "it gave nothing", "try again");
        if (key.level == 0) std::this_thread::sleep_for(delay.load());
        if (key.dataset == watched && !readAt) readAt = tilesBegun.load();
        MemoryVolumeProvider::readSlices(key, zBegin, zCount, out);
    }
    std::atomic<std::chrono::milliseconds> delay{std::chrono::milliseconds(0)};
    std::atomic<bool> failing{false};
    std::atomic<bool> failingLevel0{false};
    std::string watched;               ///< a dataset
    mutable std::optional<int> readAt; ///< tilesBegun when the watched one was first read
    std::atomic<int> tilesBegun{0};
    std::string blocked; ///< a dataset whose reads end only when the gate is open
    std::atomic<bool> gate{false};
    void openGate() {
        gate = true;
        gate.notify_all();
    }
};

class FrameResidency : public ::testing::Test {
protected:
    void SetUp() override {
        if (!haveOpenGl()) GTEST_SKIP() << "no EGL device gives OpenGL 4.5";
        for (int i = 0; i < kVolumes; ++i) {
            addVolume(*provider_, nameOf(i), glm::ivec3(kDim), ScalarType::F32, [i](int x, int y, int z) {
                const double c = 0.5 * (kDim - 1);
                return std::max(0.0, 255.0 - (6.0 + i) * std::hypot(x - c, y - c, z - c));
            });
        }
    }
    static TileSpec tile(int i, bool lit = false) {
        TileSpec made = frontTile(nameOf(i), kDim, 255.0, kPixels);
        made.shading.enabled = lit;
        made.shading.gradient = GradientSource::Texture;
        return made;
    }
    static FrameSpec frameOf(std::vector<TileSpec> tiles, LevelChoice levels) {
        FrameSpec frame;
        frame.tiles = std::move(tiles);
        frame.levels = levels;
        return frame;
    }
    /// Volumes are textures on every device.
    static RenderOptions byShaders() {
        RenderOptions options;
        options.choosePaths = [](const RenderDevice&) { return choosePaths({}, {}, {}); };
        return options;
    }
    static RenderOptions budget(std::uint64_t bytes) {
        auto options = byShaders();
        options.textureBudgetBytes = bytes;
        return options;
    }
    static TilePixels draw(RenderThread& thread, const TileSpec& tile, LevelChoice levels,
                           FramePriority priority = FramePriority::Interactive) {
        return thread.submit(frameOf({tile}, levels), priority).get().tiles.at(0);
    }
    /// The first picture: asks until there is one.
    static TilePixels drawAtHand(RenderThread& thread, const TileSpec& tile) {
        for (int frames = 1; frames < 2000; ++frames) {
            auto pixels = draw(thread, tile, LevelChoice::AtHand);
            if (!pixels.absent) return pixels;
            EXPECT_TRUE(pixels.awaited);
            EXPECT_TRUE(pixels.rgba8.empty());
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ADD_FAILURE() << "it stays absent";
        return {};
    }
    /// Draws at hand until nothing stands in any more.
    static int framesUntilWhole(RenderThread& thread, const TileSpec& tile) {
        for (int frames = 1; frames < 2000; ++frames) {
            const auto pixels = drawAtHand(thread, tile);
            if (!pixels.standIn) return frames;
            EXPECT_TRUE(pixels.awaited);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return -1;
    }
    void TearDown() override { provider_->openGate(); }
    std::shared_ptr<SlowProvider> provider_ = std::make_shared<SlowProvider>();
};

TEST_F(FrameResidency, ATileIsDrawnFromASmallLevelUntilItsOwnIsThere) {
    provider_->delay = std::chrono::milliseconds(20);
    // 2 MiB slices of which none is small: a volume of 128^3 whose small level is level 1.
    addVolume(*provider_, "large", glm::ivec3(2 * kDim), ScalarType::F32,
              [](int x, int y, int z) { return std::min(255.0, 1.0 * x + y + z); });
    RenderThread thread(provider_, byShaders());
    const TileSpec large = frontTile("large", 2 * kDim, 255.0, kPixels);
    const auto first = drawAtHand(thread, large);
    ASSERT_EQ(first.error, "");
    EXPECT_EQ(first.level, 1);
    EXPECT_TRUE(first.standIn);
    EXPECT_TRUE(first.awaited);
    EXPECT_EQ(first.note, "");
    TileSpec coarse = large;
    coarse.level = 1;
    EXPECT_EQ(first.rgba8, draw(thread, coarse, LevelChoice::Exact).rgba8) << "it is that level's picture";
    EXPECT_GT(framesUntilWhole(thread, large), 1);
    const auto whole = draw(thread, large, LevelChoice::AtHand);
    EXPECT_EQ(whole.level, 0);
    EXPECT_EQ(whole.rgba8, draw(thread, large, LevelChoice::Exact).rgba8);
}

TEST_F(FrameResidency, NothingStandsInForLabels) {
    // Labels 1 and 3 in turn: every mean of neighbours is a label 2 that is nowhere.
    addVolume(*provider_, "labels", glm::ivec3(2 * kDim), ScalarType::U8,
              [](int x, int y, int z) { return 1.0 + 2.0 * ((x + y + z) % 2); });
    TileSpec labels = frontTile("labels", 2 * kDim, 4.0, kPixels);
    labels.technique = Technique::Plane;
    labels.categories = true;
    TileSpec painted = frontTile(nameOf(0), kDim, 255.0, kPixels);
    painted.technique = Technique::Plane;
    VolumeLayer layer{"labels", 0, 0, 0, labels.transfer};
    layer.categories = true;
    painted.layers.volumes = {layer};
    for (const TileSpec& each : {labels, painted}) {
        RenderThread patient(provider_, byShaders());
        const auto whole = draw(patient, each, LevelChoice::Exact);
        ASSERT_EQ(whole.error, "");
        RenderThread thread(provider_, byShaders());
        EXPECT_EQ(framesUntilWhole(thread, each), 1);
        RenderThread fresh(provider_, byShaders());
        EXPECT_EQ(drawAtHand(fresh, each).rgba8, whole.rgba8);
    }
    // A budget with room for their level 1 alone gives no picture of it.
    RenderThread tight(provider_, budget(kBytes));
    for (const LevelChoice levels : {LevelChoice::WithinBudget, LevelChoice::AtHand})
        EXPECT_EQ(draw(tight, labels, levels).errorKind, ErrorKind::LimitExceeded);
}

TEST_F(FrameResidency, LightWithoutItsGradientTextureStandsInToo) {
    RenderThread thread(provider_, byShaders());
    const auto exact = draw(thread, tile(0, true), LevelChoice::Exact);
    RenderThread fresh(provider_, byShaders());
    const auto first = drawAtHand(fresh, tile(0, true));
    ASSERT_EQ(first.error, "");
    EXPECT_TRUE(first.standIn);
    EXPECT_GT(framesUntilWhole(fresh, tile(0, true)), 0);
    const auto whole = draw(fresh, tile(0, true), LevelChoice::AtHand);
    EXPECT_EQ(whole.rgba8, exact.rgba8);
    EXPECT_EQ(fresh.residency().gradientBytes, 2 * kBytes);
    EXPECT_EQ(fresh.residency().sampleBytes, kBytes);
}

TEST_F(FrameResidency, PicturesOfASwappedWorkingSetAreThoseOfALargeBudget) {
    RenderThread roomy(provider_, byShaders());
    // Lit tiles take three times a volume: none but the one that is drawn fits.
    RenderThread tight(provider_, budget(3 * kBytes + kBytes / 2));
    std::vector<TileSpec> tiles;
    for (int round = 0; round < 2; ++round)
        for (int i = 0; i < kVolumes; ++i)
            tiles.push_back(tile(i, i % 2 == 0));
    const auto expected = roomy.submit(frameOf(tiles, LevelChoice::Exact), FramePriority::Final).get();
    for (const LevelChoice levels : {LevelChoice::Exact, LevelChoice::WithinBudget}) {
        const auto swapped = tight.submit(frameOf(tiles, levels), FramePriority::Final).get();
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            ASSERT_EQ(swapped.tiles[i].error, "");
            EXPECT_FALSE(swapped.tiles[i].standIn);
            EXPECT_EQ(swapped.tiles[i].note, "");
            EXPECT_EQ(swapped.tiles[i].rgba8, expected.tiles[i].rgba8) << i;
        }
        EXPECT_LE(tight.residency().residentBytes, tight.residency().budgetBytes);
    }
    EXPECT_GT(tight.residency().evictions, 6U);
}

TEST_F(FrameResidency, TheDiskReadsWhileTilesThatAreAtHandAreDrawn) {
    const auto memory = std::make_shared<HostVolumeCache>(
        provider_, HostCacheOptions{.budgetBytes = 6 * kBytes, .pageCache = PageCacheUse::Keep});
    RenderThread roomy(provider_, byShaders());
    RenderThread thread(memory, budget(kBytes + kBytes / 2));
    for (int i = 0; i < 4; ++i)
        (void)draw(thread, tile(i), LevelChoice::Exact);
    provider_->watched = nameOf(5);
    const std::vector<TileSpec> tiles{tile(0), tile(5), tile(1), tile(2), tile(3)}; // 3 is resident
    const auto drawn = thread
                           .submit(frameOf(tiles, LevelChoice::Exact), FramePriority::Interactive,
                                   [&] {
                                       ++provider_->tilesBegun;
                                       std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                       return false;
                                   })
                           .get();
    ASSERT_TRUE(provider_->readAt);
    EXPECT_LE(*provider_->readAt, 3) << "of five: not only once the others are drawn";
    for (std::size_t i = 0; i < tiles.size(); ++i)
        EXPECT_EQ(drawn.tiles[i].rgba8, draw(roomy, tiles[i], LevelChoice::Exact).rgba8) << i;
}

TEST_F(FrameResidency, ATileWhoseDatasetIsGoneFailsAloneBesideOnesOnTheDisk) {
    const auto memory = std::make_shared<HostVolumeCache>(
        provider_, HostCacheOptions{.budgetBytes = 6 * kBytes, .pageCache = PageCacheUse::Keep});
    RenderThread thread(memory, budget(kBytes + kBytes / 2));
    TileSpec gone = tile(0);
    gone.dataset = "gone";
    const auto drawn =
        thread.submit(frameOf({tile(1), gone, tile(2)}, LevelChoice::Exact), FramePriority::Interactive)
            .get();
    EXPECT_EQ(drawn.tiles[1].errorKind, ErrorKind::NotFound);
    EXPECT_EQ(drawn.tiles[0].error + drawn.tiles[2].error, "");
}

TEST_F(FrameResidency, ALevelAboveTheBudgetIsAnErrorOrACoarserLevelThatSaysSo) {
    RenderThread thread(provider_, budget(kBytes - 1));
    const auto exact = draw(thread, tile(0), LevelChoice::Exact, FramePriority::Export);
    EXPECT_EQ(exact.errorKind, ErrorKind::LimitExceeded);
    EXPECT_NE(exact.error.find("--texture-budget"), std::string::npos) << exact.error;
    EXPECT_TRUE(exact.rgba8.empty());
    TileSpec coarse = tile(0);
    coarse.level = 1;
    const auto expected = draw(thread, coarse, LevelChoice::Exact);
    for (const LevelChoice levels : {LevelChoice::WithinBudget, LevelChoice::AtHand}) {
        const auto pixels = draw(thread, tile(0), levels);
        ASSERT_EQ(pixels.error, "");
        EXPECT_EQ(pixels.level, 1);
        EXPECT_NE(pixels.note.find("level 1 instead of 0"), std::string::npos) << pixels.note;
        EXPECT_FALSE(pixels.standIn) << "nothing better will come";
        EXPECT_EQ(pixels.rgba8, expected.rgba8);
    }
    RenderThread hopeless(provider_, budget(100));
    for (const LevelChoice levels : {LevelChoice::Exact, LevelChoice::WithinBudget, LevelChoice::AtHand})
        EXPECT_EQ(draw(hopeless, tile(0), levels).errorKind, ErrorKind::LimitExceeded);
}

TEST_F(FrameResidency, WhatIsVisibleStaysWhenTheRestIsTooLarge) {
    RenderThread thread(provider_, budget(3 * kBytes));
    std::vector<WantedVolume> wanted;
    std::vector<TileSpec> tiles;
    for (int i = 0; i < kVolumes; ++i) {
        wanted.push_back({{nameOf(i), 0, 0, 0}, WantedPriority::Visible, {}});
        tiles.push_back(tile(i));
    }
    thread.setWanted(wanted);
    // Six visible volumes, room for two and the small levels of the others: frames at hand settle.
    std::uint64_t evictions = 0;
    std::vector<int> levels(kVolumes);
    for (int round = 0; round < 60; ++round) {
        const auto frame =
            thread.submit(frameOf(tiles, LevelChoice::AtHand), FramePriority::Interactive).get();
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            ASSERT_EQ(frame.tiles[i].error, "");
            levels[i] = frame.tiles[i].level;
        }
        ASSERT_LE(thread.residency().residentBytes, 3 * kBytes);
        if (round == 40) evictions = thread.residency().evictions;
    }
    EXPECT_EQ(thread.residency().evictions, evictions) << "no swapping while people interact";
    EXPECT_GE(std::count(levels.begin(), levels.end(), 0), 2);
    const auto whole = thread.submit(frameOf(tiles, LevelChoice::Exact), FramePriority::Final).get();
    for (const auto& pixels : whole.tiles)
        EXPECT_EQ(pixels.level, 0) << "at rest all are drawn whole, one after another";
}

TEST_F(FrameResidency, WhatIsWantedSoonIsBroughtInWhileNothingIsDrawn) {
    RenderThread thread(provider_, byShaders());
    thread.setWanted(
        {{{nameOf(1), 0, 0, 0}, WantedPriority::Soon, {}}, {{"nobody", 0, 0, 0}, WantedPriority::Soon, {}}});
    for (int i = 0; i < 2000 && thread.residency().textures == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(thread.residency().sampleBytes, kBytes);
    EXPECT_EQ(thread.residency().queuedUploads, 0);
    EXPECT_EQ(draw(thread, tile(1), LevelChoice::AtHand).level, 0);
}

TEST_F(FrameResidency, AnUrgentFrameWaitsForNoDisk) {
    // 16 chunks of 200 ms: 3 s to bring in.
    addVolume(*provider_, "slow", glm::ivec3(256, 256, kDim), ScalarType::F32,
              [](int x, int, int) { return static_cast<double>(x); });
    RenderThread thread(provider_, byShaders());
    ASSERT_EQ(draw(thread, tile(0), LevelChoice::Exact).error, "");
    provider_->delay = std::chrono::milliseconds(200);
    auto slow = thread.submit(frameOf({frontTile("slow", 256, 255.0, kPixels)}, LevelChoice::Exact),
                              FramePriority::Export);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::vector<double> times;
    while (slow.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        const auto start = std::chrono::steady_clock::now();
        ASSERT_EQ(draw(thread, tile(0), LevelChoice::AtHand).error, "");
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(slow.get().tiles.at(0).error, "");
    EXPECT_GT(times.size(), 10U);
    // The median, for the machine may be busy: a frame that waited for a chunk would take 200 ms, as most
    // did.
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                     times.end());
    EXPECT_LT(times[times.size() / 2], 100.0);
}

TEST_F(FrameResidency, ATileOfWhichNothingIsReadYetIsLeftOutAndTheOthersAreDrawn) {
    provider_->blocked = nameOf(1);
    RenderThread thread(provider_, byShaders());
    const auto expected = draw(thread, tile(0), LevelChoice::Exact);
    const std::vector<TileSpec> tiles{tile(1), tile(0), tile(1, true)};
    for (int frame = 0; frame < 3; ++frame) { // it would never come back if it waited
        const auto drawn =
            thread.submit(frameOf(tiles, LevelChoice::AtHand), FramePriority::Interactive).get();
        for (const std::size_t missing : {0U, 2U}) {
            EXPECT_TRUE(drawn.tiles[missing].absent);
            EXPECT_TRUE(drawn.tiles[missing].awaited);
            EXPECT_EQ(drawn.tiles[missing].error, "");
            EXPECT_TRUE(drawn.tiles[missing].rgba8.empty());
        }
        EXPECT_FALSE(drawn.tiles[1].absent);
        EXPECT_EQ(drawn.tiles[1].rgba8, expected.rgba8);
    }
    provider_->openGate();
    EXPECT_EQ(drawAtHand(thread, tile(1)).rgba8, draw(thread, tile(1), LevelChoice::Exact).rgba8);
}

TEST_F(FrameResidency, WhatFailsWhileATileIsLeftOutIsTheTilesErrorOnce) {
    provider_->blocked = nameOf(1);
    RenderThread thread(provider_, byShaders());
    EXPECT_TRUE(draw(thread, tile(1), LevelChoice::AtHand).absent);
    provider_->failing = true;
    provider_->openGate();
    for (int i = 0; i < 2000 && thread.residency().queuedUploads > 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    provider_->failing = false;
    const auto failed = draw(thread, tile(1), LevelChoice::AtHand);
    EXPECT_FALSE(failed.absent);
    EXPECT_NE(failed.error.find("disk"), std::string::npos) << failed.error;
    EXPECT_EQ(drawAtHand(thread, tile(1)).error, "") << "it is asked for anew";
}

TEST_F(FrameResidency, NothingIsAwaitedOfALevelThatCannotBeRead) {
    addVolume(*provider_, "large", glm::ivec3(2 * kDim), ScalarType::F32,
              [](int x, int y, int z) { return std::min(255.0, 1.0 * x + y + z); });
    const TileSpec large = frontTile("large", 2 * kDim, 255.0, kPixels);
    RenderThread thread(provider_, byShaders());
    provider_->failingLevel0 = true;
    TilePixels pixels = drawAtHand(thread, large);
    for (int i = 0; i < 2000 && pixels.awaited; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        pixels = drawAtHand(thread, large);
    }
    EXPECT_EQ(pixels.error, "");
    EXPECT_EQ(pixels.level, 1);
    EXPECT_TRUE(pixels.standIn);
    EXPECT_FALSE(pixels.awaited) << "asking again is of no use";
    EXPECT_NE(draw(thread, large, LevelChoice::WithinBudget).error.find("disk"), std::string::npos);
    provider_->failingLevel0 = false;
    EXPECT_EQ(draw(thread, large, LevelChoice::WithinBudget).level, 0) << "and it may be tried again";
}

TEST_F(FrameResidency, AFailedReadIsTheTilesError) {
    RenderThread thread(provider_, byShaders());
    provider_->failing = true;
    const auto failed = draw(thread, tile(1), LevelChoice::Exact);
    EXPECT_NE(failed.error.find("disk"), std::string::npos) << failed.error;
    provider_->failing = false;
    EXPECT_EQ(draw(thread, tile(1), LevelChoice::Exact).error, "") << "it is asked for anew";
}

} // namespace
} // namespace voxsheet
