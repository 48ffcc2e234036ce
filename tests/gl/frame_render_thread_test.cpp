#include "frame/render_thread.h"

#include "base/errors.h"
#include "frame/timer_check.h"
#include "gl_fixture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace voxsheet {
namespace {

constexpr int kDim = 32;
constexpr int kPixels = 48;

double ball(int x, int y, int z) {
    const double c = 0.5 * (kDim - 1);
    return std::max(0.0, 255.0 - 16.0 * std::hypot(x - c, y - c, z - c));
}

/// Bright below, empty above, in the world's y; so that a flipped picture shows.
double lowerHalf(int, int y, int) { return y < kDim / 2 ? 200.0 : 0.0; }

FrameSpec frameOf(std::initializer_list<TileSpec> tiles, PixelFormat format = PixelFormat::Rgba8) {
    FrameSpec frame;
    frame.tiles = tiles;
    frame.format = format;
    return frame;
}

unsigned char channel(const TilePixels& tile, int x, int yFromTop, int component) {
    return tile.rgba8[static_cast<std::size_t>((yFromTop * tile.size.x + x) * 4 + component)];
}

class RenderThreadTest : public ::testing::Test {
protected:
    void SetUp() override {
        if (!haveOpenGl()) GTEST_SKIP() << "no EGL device gives OpenGL 4.5";
        addVolume(*provider_, "ball", glm::ivec3(kDim), ScalarType::U8, ball);
        addVolume(*provider_, "lower", glm::ivec3(kDim), ScalarType::U8, lowerHalf);
        addVolume(*provider_, "float", glm::ivec3(kDim), ScalarType::F32, ball);
    }
    static TileSpec tile(const std::string& dataset, Technique technique = Technique::Raycast) {
        TileSpec made = frontTile(dataset, kDim, 255.0, kPixels);
        made.technique = technique;
        return made;
    }
    FrameResult draw(RenderThread& thread, FrameSpec frame) {
        return thread.submit(std::move(frame), FramePriority::Final).get();
    }
    std::shared_ptr<MemoryVolumeProvider> provider_ = std::make_shared<MemoryVolumeProvider>();
};

TEST_F(RenderThreadTest, TimestampsAgreeWithTheHostsClock) {
    RenderThread thread(provider_, {});
    for (const Technique technique : {Technique::Raycast, Technique::Slices, Technique::Mip}) {
        auto big = tile("ball", technique);
        big.sizePixels = glm::ivec2(512);
        FrameSpec frame = frameOf({big, big, big, big});
        frame.checkTimers = true;
        (void)draw(thread, frame); // compiles
        TimerCheck check;
        for (int repeat = 0; repeat < 3; ++repeat)
            check.add(draw(thread, frame));
        EXPECT_EQ(check.tiles(), 12);
        EXPECT_TRUE(check.agrees()) << check.gpuMs() << " ms by timestamps, " << check.hostMs()
                                    << " ms by the host";
    }
}

/// Some five times as many samples as the first band of a fresh thread.
TileSpec largeTile(TileSpec tile) {
    tile.sizePixels = {480, 301}; // the last band is no multiple of 8
    tile.sampleDistanceVoxels = 0.1;
    return tile;
}

TEST_F(RenderThreadTest, ALargeTileInBandsHasTheBitsOfTheWholeOne) {
    for (const Technique technique :
         {Technique::Raycast, Technique::Slices, Technique::Mip, Technique::Surface, Technique::Isosurface})
        for (const bool shaded : {false, true}) {
            RenderThread thread(provider_, {}); // has learned no pace
            TileSpec large = largeTile(tile("ball", technique));
            large.isosurface.surfaces = {{100.0, {0.2F, 0.6F, 0.9F, 0.5F}}};
            large.shading.enabled = shaded;
            large.clip.planes = {{glm::normalize(glm::dvec3(1.0, 0.3, -0.2)), 8.0}};
            TileSpec small = large; // brings the volume in
            small.sizePixels = glm::ivec2(16);
            ASSERT_EQ(thread.submit(frameOf({small}), FramePriority::Interactive).get().tiles.at(0).error,
                      "");
            const auto drawn = [&](FramePriority priority) {
                int looks = 0; // before each band
                auto result = thread.submit(frameOf({large}, PixelFormat::Rgba32F), priority, [&] {
                    ++looks;
                    return false;
                });
                auto picture = result.get().tiles.at(0);
                EXPECT_EQ(picture.error, "");
                if (priority == FramePriority::Interactive) {
                    EXPECT_EQ(looks, 1);
                } else {
                    EXPECT_GT(looks, 2) << static_cast<int>(technique) << shaded;
                }
                return picture;
            };
            const auto whole = drawn(FramePriority::Interactive);
            const auto inBands = drawn(FramePriority::Final);
            EXPECT_TRUE(whole.rgba32f == inBands.rgba32f) << static_cast<int>(technique) << shaded;
            EXPECT_TRUE(
                std::any_of(whole.rgba32f.begin(), whole.rgba32f.end(), [](float f) { return f > 0.1F; }));
            EXPECT_GT(inBands.renderMs, 0.0);
        }
}

TEST_F(RenderThreadTest, AnUrgentFrameGoesInBetweenTheBandsOfALargeTile) {
    RenderThread thread(provider_, {});
    auto large = largeTile(tile("ball"));
    large.sampleDistanceVoxels = 0.02; // longer than any other tile here
    const auto alone = draw(thread, frameOf({large}));
    if (alone.tiles.at(0).renderMs < 100.0)
        GTEST_SKIP() << "this device draws the largest tile in " << alone.tiles.at(0).renderMs
                     << " ms: it has no bands";
    std::atomic<int> looks{0};
    auto last = thread.submit(frameOf({large}), FramePriority::Final, [&] {
        ++looks;
        return false;
    });
    while (looks == 0)
        std::this_thread::yield();
    // Of the large tile's size, so that it might take its target.
    auto urgent = tile("lower");
    urgent.sizePixels = large.sizePixels;
    EXPECT_EQ(thread.submit(frameOf({urgent}), FramePriority::Interactive).get().tiles.at(0).error, "");
    EXPECT_EQ(last.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
    EXPECT_TRUE(last.get().tiles.at(0).rgba8 == alone.tiles.at(0).rgba8);
    EXPECT_GT(looks, 2);

    std::atomic<int> more{0};
    auto unwanted = thread.submit(frameOf({large}), FramePriority::Final, [&] { return ++more > 2; });
    EXPECT_THROW((void)unwanted.get(), Cancelled);
    EXPECT_EQ(draw(thread, frameOf({tile("ball")})).tiles.at(0).error, "");
}

TEST_F(RenderThreadTest, DrawsAVolumeByEveryTechnique) {
    RenderThread thread(provider_, {});
    for (const Technique technique : {Technique::Raycast, Technique::Slices, Technique::Mip}) {
        const FrameResult frame = draw(thread, frameOf({tile("ball", technique)}));
        const TilePixels& picture = frame.tiles.at(0);
        ASSERT_EQ(picture.error, "");
        ASSERT_EQ(picture.rgba8.size(), static_cast<std::size_t>(kPixels * kPixels * 4));
        EXPECT_GT(channel(picture, kPixels / 2, kPixels / 2, 0), 90) << "the ball's middle is bright";
        EXPECT_LT(channel(picture, 0, 0, 0), 5) << "the corners are background";
        EXPECT_EQ(channel(picture, 0, 0, 3), 255);
        EXPECT_GT(picture.renderMs, 0.0);
        EXPECT_GE(frame.wallMs, picture.renderMs);
    }
}

TEST_F(RenderThreadTest, TheTopRowComesFirst) {
    RenderThread thread(provider_, {});
    for (const Technique technique : {Technique::Raycast, Technique::Slices, Technique::Mip}) {
        const FrameResult frame = draw(thread, frameOf({tile("lower", technique)}));
        const TilePixels& picture = frame.tiles.at(0);
        ASSERT_EQ(picture.error, "");
        EXPECT_GT(channel(picture, kPixels / 2, kPixels - 8, 0), 90);
        EXPECT_EQ(channel(picture, kPixels / 2, 8, 0), 0);
    }
}

TEST_F(RenderThreadTest, BlendsTheBackgroundUnderTheVolume) {
    RenderThread thread(provider_, {});
    TileSpec transparent = tile("ball");
    transparent.background = glm::vec4(0.2F, 0.4F, 0.6F, 0.0F);
    TileSpec coloured = transparent;
    coloured.background = glm::vec4(0.2F, 0.4F, 0.6F, 0.5F);
    const FrameResult frame = draw(thread, frameOf({transparent, coloured}, PixelFormat::Rgba32F));
    const auto& clear = frame.tiles.at(0).rgba32f;
    const auto& over = frame.tiles.at(1).rgba32f;
    ASSERT_EQ(clear.size(), static_cast<std::size_t>(kPixels * kPixels * 4));
    ASSERT_EQ(over.size(), clear.size());
    const float background[] = {0.1F, 0.2F, 0.3F, 0.5F}; // premultiplied
    float largestAlpha = 0.0F;
    for (std::size_t i = 0; i < clear.size(); ++i) {
        const float alpha = clear[i - i % 4 + 3];
        largestAlpha = std::max(largestAlpha, alpha);
        ASSERT_NEAR(over[i], clear[i] + (1.0F - alpha) * background[i % 4], 1e-6F) << i;
    }
    EXPECT_GT(largestAlpha, 0.5F);
    EXPECT_EQ(clear[3], 0.0F) << "a corner with no background is transparent";

    const FrameResult bytes = draw(thread, frameOf({coloured}));
    for (std::size_t i = 0; i < over.size(); ++i) {
        const double exact = std::clamp(static_cast<double>(over[i]), 0.0, 1.0) * 255.0;
        ASSERT_NEAR(static_cast<double>(bytes.tiles.at(0).rgba8[i]), exact, 0.5001) << i;
    }
}

TEST_F(RenderThreadTest, TheSameSpecGivesTheSameBytes) {
    RenderThread thread(provider_, {});
    const FrameResult first = draw(thread, frameOf({tile("ball"), tile("lower"), tile("ball")}));
    const FrameResult second = draw(thread, frameOf({tile("lower"), tile("ball")}));
    EXPECT_EQ(first.tiles.at(0).rgba8, first.tiles.at(2).rgba8);
    EXPECT_EQ(first.tiles.at(0).rgba8, second.tiles.at(1).rgba8);
    EXPECT_EQ(first.tiles.at(1).rgba8, second.tiles.at(0).rgba8);
    EXPECT_EQ(thread.residency().textures, 2) << "one copy per volume";
}

TEST_F(RenderThreadTest, ATileThatFailsLeavesTheOthersWhole) {
    RenderThread thread(provider_, {});
    TileSpec missing = tile("nobody");
    TileSpec huge = tile("ball");
    huge.sizePixels = glm::ivec2(9000, 10);
    TileSpec noTable = tile("ball");
    noTable.transfer = nullptr;
    TileSpec noLevel = tile("ball");
    noLevel.level = 7;
    const FrameResult frame =
        draw(thread, frameOf({missing, tile("ball"), huge, noTable, noLevel, tile("ball")}));
    const FrameResult alone = draw(thread, frameOf({tile("ball")}));
    for (const std::size_t failed : {0U, 2U, 3U, 4U}) {
        EXPECT_NE(frame.tiles.at(failed).error, "") << failed;
        EXPECT_TRUE(frame.tiles.at(failed).rgba8.empty());
    }
    EXPECT_EQ(frame.tiles.at(0).errorKind, ErrorKind::NotFound);
    EXPECT_EQ(frame.tiles.at(2).errorKind, ErrorKind::InvalidInput);
    EXPECT_EQ(frame.tiles.at(1).rgba8, alone.tiles.at(0).rgba8);
    EXPECT_EQ(frame.tiles.at(5).rgba8, alone.tiles.at(0).rgba8);
}

TEST_F(RenderThreadTest, SwapsAWorkingSetLargerThanTheBudget) {
    const auto spec = [&] {
        FrameSpec frame;
        for (int i = 0; i < 3; ++i) {
            for (const char* key : {"ball", "lower", "float"})
                frame.tiles.push_back(tile(key));
        }
        return frame;
    };
    RenderThread roomy(provider_, {});
    RenderOptions tightOptions;
    // The float volume, or two of 16 bits, with the border that they have in host memory.
    tightOptions.textureBudgetBytes = std::uint64_t{kDim + 2} * (kDim + 2) * (kDim + 2) * 4 + 1024;
    RenderThread tight(provider_, tightOptions);
    const FrameResult expected = draw(roomy, spec());
    for (int round = 0; round < 2; ++round) {
        const FrameResult swapped = draw(tight, spec());
        for (std::size_t i = 0; i < 9; ++i) {
            ASSERT_EQ(swapped.tiles.at(i).error, "");
            EXPECT_EQ(swapped.tiles.at(i).rgba8, expected.tiles.at(i).rgba8) << i;
        }
        EXPECT_LE(tight.residency().residentBytes, tightOptions.textureBudgetBytes);
    }
    EXPECT_GT(tight.residency().evictions, 0U);
    EXPECT_EQ(roomy.residency().evictions, 0U);
    // Tiles of one volume are drawn together: at most one upload per volume and frame.
    EXPECT_LE(tight.residency().uploadedBytes, 2 * roomy.residency().uploadedBytes);
}

TEST_F(RenderThreadTest, ASecondThreadLivesBesideTheFirst) {
    RenderThread first(provider_, {});
    const FrameResult before = draw(first, frameOf({tile("ball")}));
    {
        RenderThread second(provider_, {});
        EXPECT_EQ(draw(second, frameOf({tile("ball")})).tiles.at(0).rgba8, before.tiles.at(0).rgba8);
    }
    EXPECT_EQ(draw(first, frameOf({tile("ball")})).tiles.at(0).rgba8, before.tiles.at(0).rgba8);
}

TEST_F(RenderThreadTest, StopsACancelledFrameBetweenTiles) {
    RenderThread thread(provider_, {});
    FrameSpec frame;
    for (int i = 0; i < 50; ++i)
        frame.tiles.push_back(tile("ball"));
    std::atomic<int> asked = 0;
    auto future = thread.submit(frame, FramePriority::Final, [&] { return ++asked > 3; });
    EXPECT_THROW(future.get(), Cancelled);
    EXPECT_EQ(asked, 4);
    EXPECT_EQ(draw(thread, frameOf({tile("ball")})).tiles.at(0).error, "");
}

TEST_F(RenderThreadTest, AMoreUrgentFrameGoesBetweenTwoTiles) {
    RenderThread thread(provider_, {});
    std::atomic<int> exported = 0;
    std::promise<void> started;
    std::promise<void> urgentIsQueued;
    FrameSpec longFrame;
    for (int i = 0; i < 20; ++i)
        longFrame.tiles.push_back(tile("ball"));
    auto slow = thread.submit(longFrame, FramePriority::Export, [&] {
        if (++exported == 2) {
            started.set_value();
            urgentIsQueued.get_future().wait();
        }
        return false;
    });
    started.get_future().wait();
    int exportedWhenDrawn = 0;
    auto urgent = thread.submit(frameOf({tile("lower")}), FramePriority::Interactive, [&] {
        exportedWhenDrawn = exported;
        return false;
    });
    urgentIsQueued.set_value();
    EXPECT_EQ(urgent.get().tiles.at(0).error, "");
    EXPECT_EQ(exportedWhenDrawn, 2) << "drawn right after the tile that was under way";
    EXPECT_EQ(slow.get().tiles.size(), 20U);
}

TEST_F(RenderThreadTest, ForgetsADataset) {
    RenderThread thread(provider_, {});
    const auto before = draw(thread, frameOf({tile("ball"), tile("lower")})).tiles.at(0).rgba8;
    provider_->remove("ball");
    addVolume(*provider_, "ball", glm::ivec3(kDim), ScalarType::U8, lowerHalf);
    thread.forget("ball");
    const FrameResult after = draw(thread, frameOf({tile("ball"), tile("lower")}));
    EXPECT_NE(after.tiles.at(0).rgba8, before);
    EXPECT_EQ(after.tiles.at(0).rgba8, after.tiles.at(1).rgba8);
    EXPECT_EQ(thread.residency().textures, 2);
}

TEST_F(RenderThreadTest, WaitingFramesAreCancelledAtTheEnd) {
    std::future<FrameResult> waiting;
    std::future<FrameResult> running;
    std::promise<void> started;
    std::promise<void> mayGoOn;
    std::thread release;
    {
        RenderThread thread(provider_, {});
        running = thread.submit(frameOf({tile("ball"), tile("ball")}), FramePriority::Interactive,
                                [&, asked = 0]() mutable {
                                    if (++asked == 1) {
                                        started.set_value();
                                        mayGoOn.get_future().wait();
                                    }
                                    return false;
                                });
        waiting = thread.submit(frameOf({tile("ball")}), FramePriority::Export);
        started.get_future().wait();
        release = std::thread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            mayGoOn.set_value();
        });
    }
    release.join();
    EXPECT_THROW(waiting.get(), Cancelled);
}

TEST_F(RenderThreadTest, AnEmptyFrameAndOddSizesAreFine) {
    RenderThread thread(provider_, {});
    EXPECT_TRUE(draw(thread, {}).tiles.empty());
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 300), glm::ivec2(517, 3)}) {
        TileSpec odd = tile("ball");
        odd.sizePixels = size;
        const FrameResult frame = draw(thread, frameOf({odd}));
        ASSERT_EQ(frame.tiles.at(0).error, "");
        EXPECT_EQ(frame.tiles.at(0).rgba8.size(), static_cast<std::size_t>(size.x * size.y * 4));
    }
}

TEST_F(RenderThreadTest, RefusesADeviceThatDoesNotExist) {
    RenderOptions options;
    options.device = 1000;
    EXPECT_THROW(RenderThread(provider_, options), InvalidInput);
}

} // namespace
} // namespace voxsheet
