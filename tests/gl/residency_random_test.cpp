// The residency manager under random load: what must hold after every single step.
#include "residency/residency_manager.h"

#include "base/errors.h"
#include "gl_fixture.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <random>
#include <thread>
#include <vector>

namespace voxsheet {
namespace {

constexpr int kDim = 16;
constexpr std::uint64_t kBytes = std::uint64_t{kDim} * kDim * kDim * 4; ///< of one F32 volume
constexpr int kVolumes = 12;

std::string nameOf(int volume) { return "v" + std::to_string(volume); }

const DerivedTextureBuilder kNothing = [](const ResidentVolume&, gpu::Texture&, int, int) {};

Deadline now() { return std::chrono::steady_clock::now(); }

class ResidencyRandom : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        for (int i = 0; i < kVolumes; ++i)
            addVolume(*provider_, nameOf(i), glm::ivec3(kDim + (i % 3) * 4, kDim, kDim),
                      i % 2 == 0 ? ScalarType::F32 : ScalarType::U8,
                      [i](int x, int, int) { return static_cast<double>(i * 20 + x % 3); });
    }

    /// The texel in the middle, as a value: the texture is the one that its name says, and is filled.
    static double middle(const ResidentVolume& volume) {
        float texel = 0.0F;
        glGetTextureSubImage(volume.texture->id(), 0, volume.dims.x / 2, volume.dims.y / 2, volume.dims.z - 1,
                             1, 1, 1, GL_RED, GL_FLOAT, sizeof(texel), &texel);
        return volume.valueScale * static_cast<double>(texel) + volume.valueOffset;
    }

    void check(const ResidencyManager& manager) {
        const auto state = manager.state();
        ASSERT_LE(state.residentBytes, state.budgetBytes);
        ASSERT_EQ(state.residentBytes, state.sampleBytes + state.gradientBytes + state.clipObjectBytes);
        // The sum over the textures that are alive on the device.
        ASSERT_EQ(state.residentBytes, context().counts().textureBytes);
        ASSERT_LE(state.pinnedBytes, state.residentBytes);
        ASSERT_LE(state.visibleBytes, state.residentBytes);
        ASSERT_LE(state.textures, context().counts().textures);
    }

    std::shared_ptr<MemoryVolumeProvider> provider_ = std::make_shared<MemoryVolumeProvider>();
};

TEST_F(ResidencyRandom, NeverAboveBudgetNeverAMissingTextureCountsExact) {
    ResidencyManager manager(context(), provider_, 7 * kBytes);
    std::mt19937 random(12345);
    const auto below = [&](int count) { return std::uniform_int_distribution(0, count - 1)(random); };
    std::deque<VolumeLease> held;
    int refused = 0;
    int drawn = 0;
    const auto keep = [&](std::optional<VolumeLease> lease, int volume) {
        if (!lease) return;
        ++drawn;
        ASSERT_NE(lease->volume().texture, nullptr);
        ASSERT_NEAR(middle(lease->volume()), volume * 20 + 1.0, 1.1) << nameOf(volume);
        if (below(2) == 0) held.push_back(std::move(*lease));
        while (held.size() > 3)
            held.pop_front();
    };
    for (int step = 0; step < 6000; ++step) {
        const int volume = below(kVolumes);
        const VolumeKey key{nameOf(volume), 0, 0, 0};
        const auto texels = below(4) == 0 ? FloatTexels::Half : FloatTexels::Full;
        try {
            switch (below(12)) {
            case 0:
            case 1:
            case 2:
                keep(manager.acquire(key, texels, below(2) == 0 ? SamplesUse::Drawing : SamplesUse::Clipping),
                     volume);
                break;
            case 3:
                keep(manager.acquireBy(now(), key, texels), volume);
                break;
            case 4: {
                const auto gradients = manager.acquireGradientsBy(now(), key, texels, kNothing);
                if (!gradients) break;
                ASSERT_EQ(gradients->volume().texture->internalFormat(), GLenum{GL_RGBA16F});
                break;
            }
            case 5:
                keep(manager.acquireResident(key, texels), volume);
                ASSERT_EQ(manager.isResident(key, texels), manager.acquireResident(key, texels).has_value());
                break;
            case 6:
                (void)manager.request(key, texels);
                break;
            case 7:
                (void)manager.requestGradients(key, texels, kNothing);
                break;
            case 8: {
                std::vector<WantedVolume> wanted;
                for (int i = below(5); i > 0; --i)
                    wanted.push_back({{nameOf(below(kVolumes)), 0, 0, 0},
                                      below(2) == 0 ? WantedPriority::Visible : WantedPriority::Soon,
                                      FloatTexels::Full});
                manager.setWanted(wanted);
                break;
            }
            case 9:
                // What is under lease is not counted any more, so that the sums would differ by it.
                held.clear();
                manager.forget(key.dataset);
                break;
            case 10:
                if (!held.empty()) held.pop_front();
                break;
            default:
                (void)manager.advance(now());
            }
        } catch (const LimitExceeded&) {
            ++refused; // leases and the volume together are above the budget
            ASSERT_FALSE(held.empty());
        }
        ASSERT_NO_FATAL_FAILURE(check(manager)) << step;
        for (const auto& lease : held)
            ASSERT_EQ(glIsTexture(lease.volume().texture->id()), GL_TRUE);
    }
    EXPECT_GT(drawn, 1000);
    EXPECT_GT(manager.state().evictions, 500U);
    EXPECT_LT(refused, 3000);
    held.clear();
    while (manager.advance(now())) {
    }
    EXPECT_EQ(manager.state().pinnedBytes, 0U);
    EXPECT_EQ(manager.state().queuedUploads, 0);
    EXPECT_EQ(manager.state().queuedBytes, 0U);
}

TEST_F(ResidencyRandom, WhatIsVisibleIsEvictedLast) {
    ResidencyManager manager(context(), provider_, 3 * kBytes);
    const VolumeKey seen{"v0", 0, 0, 0};
    const VolumeKey soon{"v6", 0, 0, 0};
    manager.setWanted({{seen, WantedPriority::Visible, {}}, {soon, WantedPriority::Soon, {}}});
    while (manager.advance(now())) {
    }
    EXPECT_TRUE(manager.isResident(seen));
    EXPECT_TRUE(manager.isResident(soon)) << "brought in ahead of time";
    EXPECT_EQ(manager.state().visibleBytes, kBytes);
    // v0 is by far the least recently used: without priorities it would be the first to go.
    (void)manager.acquire({"v1", 0, 0, 0});
    (void)manager.acquire({"v3", 0, 0, 0}); // 2-byte texels: half of kBytes
    (void)manager.acquire({"v5", 0, 0, 0});
    EXPECT_TRUE(manager.isResident(seen));
    (void)manager.acquire({"v0", 0, 0, 0}, FloatTexels::Half);
    (void)manager.acquire({"v2", 0, 0, 0}, FloatTexels::Half);
    EXPECT_TRUE(manager.isResident(seen));
    EXPECT_FALSE(manager.isResident(soon)) << "soon goes before visible";
    {
        // At any price: even what is visible.
        const auto first = manager.acquire({"v6", 0, 0, 0});
        const auto second = manager.acquire({"v6", 0, 0, 0}, FloatTexels::Half);
        const auto third = manager.acquire({"v0", 0, 0, 0}, FloatTexels::Half);
        const auto fourth = manager.acquire({"v3", 0, 0, 0});
        const auto fifth = manager.acquire({"v1", 0, 0, 1});
        EXPECT_FALSE(manager.isResident(seen));
    }
}

TEST_F(ResidencyRandom, TheBackgroundTakesNoRoomFromWhatIsVisible) {
    ResidencyManager manager(context(), provider_, 2 * kBytes);
    const VolumeKey a{"v0", 0, 0, 0};
    const VolumeKey b{"v6", 0, 0, 0};
    manager.setWanted({{a, WantedPriority::Visible, {}}, {b, WantedPriority::Visible, {}}});
    while (manager.advance(now())) {
    }
    EXPECT_TRUE(manager.isResident(a) && manager.isResident(b));
    addVolume(*provider_, "third", glm::ivec3(kDim), ScalarType::F32, [](int, int, int) { return 1.0; });
    EXPECT_FALSE(manager.request({"third", 0, 0, 0})) << "says so at once";
    EXPECT_FALSE(manager.advance(now()));
    EXPECT_TRUE(manager.isResident(a) && manager.isResident(b));
    manager.setWanted({{a, WantedPriority::Visible, {}}});
    EXPECT_TRUE(manager.request({"third", 0, 0, 0})) << "b is not looked at any more";
    while (manager.advance(now())) {
    }
    EXPECT_TRUE(manager.isResident(a) && manager.isResident({"third", 0, 0, 0}));
    EXPECT_FALSE(manager.isResident(b));
}

TEST_F(ResidencyRandom, AnUploadGoesOnInSlicesAndIsGivenUpWhenNobodyWantsIt) {
    const int slices = 64;
    // One slice is a whole chunk of 1 MiB.
    addVolume(*provider_, "large", glm::ivec3(512, 512, slices), ScalarType::F32,
              [](int x, int, int z) { return static_cast<double>(x + z); });
    ResidencyManager manager(context(), provider_, std::uint64_t{1} << 30);
    const VolumeKey key{"large", 0, 0, 0};
    EXPECT_TRUE(manager.request(key));
    int calls = 0;
    std::uint64_t left = manager.state().queuedBytes;
    EXPECT_EQ(left, std::uint64_t{512} * 512 * slices * 4);
    while (manager.advance(now()) && calls < 10) {
        ++calls;
        EXPECT_LE(left - manager.state().queuedBytes, std::uint64_t{512} * 512 * 4)
            << "a chunk a call at most";
        left = manager.state().queuedBytes;
    }
    EXPECT_FALSE(manager.isResident(key));
    EXPECT_EQ(manager.state().residentBytes, std::uint64_t{512} * 512 * slices * 4) << "its texture is there";
    manager.setWanted({}); // it was asked for since the last time: once more
    EXPECT_EQ(manager.state().queuedUploads, 1);
    manager.setWanted({});
    EXPECT_EQ(manager.state().queuedUploads, 0);
    EXPECT_EQ(manager.state().residentBytes, 0U);

    EXPECT_TRUE(manager.request(key));
    while (!manager.isResident(key))
        (void)manager.advance(now());
    const auto lease = manager.acquireResident(key);
    ASSERT_TRUE(lease.has_value());
    EXPECT_GT(lease->uploadMs, 0.0) << "told to the first that draws it";
    EXPECT_EQ(manager.acquireResident(key)->uploadMs, 0.0);
    for (const int z : {0, 1, 31, slices - 1}) {
        float texel = 0.0F;
        glGetTextureSubImage(lease->volume().texture->id(), 0, 7, 500, z, 1, 1, 1, GL_RED, GL_FLOAT, 4,
                             &texel);
        EXPECT_EQ(texel, static_cast<float>(7 + z));
    }
}

TEST_F(ResidencyRandom, ClipObjectsAreCountedApartUntilTheyAreDrawn) {
    ResidencyManager manager(context(), provider_, 8 * kBytes);
    (void)manager.acquire({"v0", 0, 0, 0}, FloatTexels::Full, SamplesUse::Clipping);
    EXPECT_EQ(manager.state().clipObjectBytes, kBytes);
    EXPECT_EQ(manager.state().sampleBytes, 0U);
    (void)manager.acquire({"v0", 0, 0, 0});
    EXPECT_EQ(manager.state().clipObjectBytes, 0U);
    EXPECT_EQ(manager.state().sampleBytes, kBytes);
    EXPECT_EQ(manager.nearestResidentLevel({"v0", 0, 0, 0}, FloatTexels::Full), 0);
    EXPECT_EQ(manager.nearestResidentLevel({"v2", 0, 0, 0}, FloatTexels::Full), std::nullopt);
}

} // namespace
} // namespace voxsheet
