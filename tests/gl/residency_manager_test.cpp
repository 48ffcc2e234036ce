#include "residency/residency_manager.h"

#include "base/errors.h"
#include "gl_fixture.h"
#include "residency/host_volume_cache.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace voxsheet {
namespace {

constexpr int kDim = 16;
constexpr std::uint64_t kBytes = std::uint64_t{kDim} * kDim * kDim * 4; ///< of one F32 volume

double ramp(int x, int y, int z) { return x + 16.0 * y + 256.0 * z; }

/// Stored texels of a resident volume, as values.
std::vector<double> readValues(const ResidentVolume& volume) {
    const auto count = static_cast<std::size_t>(sampleCount(volume.dims));
    std::vector<float> texels(count);
    glGetTextureImage(volume.texture->id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(count * sizeof(float)),
                      texels.data());
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = volume.valueScale * static_cast<double>(texels[i]) + volume.valueOffset;
    }
    return values;
}

class Residency : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        provider_ = std::make_shared<MemoryVolumeProvider>();
        for (const char* key : {"a", "b", "c"}) {
            addVolume(*provider_, key, glm::ivec3(kDim), ScalarType::F32, ramp);
        }
    }
    std::shared_ptr<MemoryVolumeProvider> provider_;
};

TEST_F(Residency, KeepsOneTextureHoweverManyAskForIt) {
    ResidencyManager manager(context(), provider_, 10 * kBytes);
    const VolumeLease first = manager.acquire({"a", 0, 0, 0});
    const VolumeLease second = manager.acquire({"a", 0, 0, 0});
    EXPECT_EQ(first.volume().texture, second.volume().texture);
    EXPECT_EQ(second.uploadMs, 0.0);
    EXPECT_GT(first.uploadMs, 0.0);
    EXPECT_EQ(manager.state().textures, 1);
    EXPECT_EQ(manager.state().residentBytes, kBytes);
    EXPECT_EQ(manager.state().residentBytes, context().counts().textureBytes);
    EXPECT_EQ(manager.state().uploadedBytes, kBytes);
}

TEST_F(Residency, EvictsTheLeastRecentlyUsedAndStaysInBudget) {
    ResidencyManager manager(context(), provider_, 2 * kBytes);
    (void)manager.acquire({"a", 0, 0, 0});
    (void)manager.acquire({"b", 0, 0, 0});
    (void)manager.acquire({"a", 0, 0, 0});
    (void)manager.acquire({"c", 0, 0, 0}); // b is the oldest now
    EXPECT_TRUE(manager.isResident({"a", 0, 0, 0}));
    EXPECT_FALSE(manager.isResident({"b", 0, 0, 0}));
    EXPECT_EQ(manager.state().evictions, 1U);
    EXPECT_EQ(manager.state().residentBytes, 2 * kBytes);
    EXPECT_EQ(context().counts().textureBytes, 2 * kBytes);
}

/// Where rays are marched by the processor, what leaves the textures' budget is in host memory already.
TEST_F(Residency, TexelsOnTheHostMoveBetweenTheBudgetsWithoutACopy) {
    const TexelForm onHost{FloatTexels::Full, true};
    const std::uint64_t bytes = HostTexels::bytesFor(TexelFormat::R32F, glm::ivec3(kDim));
    const auto memory = std::make_shared<const HostVolumeCache>(
        provider_, HostCacheOptions{.budgetBytes = 3 * bytes, .pageCache = PageCacheUse::Keep});
    ResidencyManager manager(context(), memory, 2 * bytes);
    const HostTexels* texelsOfA = manager.acquire({"a", 0, 0, 0}, onHost).volume().host.get();
    EXPECT_EQ(memory->state().bytes, 0U) << "samples that became texels are not kept as well";
    (void)manager.acquire({"b", 0, 0, 0}, onHost);
    (void)manager.acquire({"c", 0, 0, 0}, onHost);
    EXPECT_FALSE(manager.isResident({"a", 0, 0, 0}, onHost));
    EXPECT_TRUE(manager.isAtHand({"a", 0, 0, 0}));
    EXPECT_GE(memory->state().bytes, bytes);
    const auto before = manager.state();
    const auto read = memory->state().diskBytes;
    const auto again = manager.acquire({"a", 0, 0, 0}, onHost);
    EXPECT_EQ(again.volume().host.get(), texelsOfA);
    ASSERT_NE(again.volume().minMax, nullptr);
    EXPECT_EQ(again.volume().rangesHash, contentHash(*again.volume().minMax));
    EXPECT_EQ(manager.state().uploads, before.uploads);
    EXPECT_EQ(memory->state().diskBytes, read);
    EXPECT_EQ(manager.state().evictions, 2U) << "b took its place";
    EXPECT_TRUE(manager.isAtHand({"b", 0, 0, 0}));
    EXPECT_EQ(manager.state().residentBytes, 2 * bytes);
}

/// The one that comes back must not be pushed out by the one that goes in its favour.
TEST_F(Residency, HostMemoryForOneLevelSwapsTwoForEver) {
    const TexelForm onHost{FloatTexels::Full, true};
    const std::uint64_t bytes = HostTexels::bytesFor(TexelFormat::R32F, glm::ivec3(kDim));
    // One level and its min-max grid, and the samples of one that is being read; not two levels.
    const auto memory = std::make_shared<const HostVolumeCache>(
        provider_, HostCacheOptions{.budgetBytes = bytes * 11 / 5, .pageCache = PageCacheUse::Keep});
    ResidencyManager manager(context(), memory, bytes * 3 / 2);
    for (int round = 0; round < 5; ++round)
        for (const char* name : {"a", "b"})
            EXPECT_NE(manager.acquire({name, 0, 0, 0}, onHost).volume().host, nullptr);
    EXPECT_EQ(manager.state().uploads, 2U);
    EXPECT_EQ(manager.state().evictions, 9U);
    EXPECT_LE(memory->state().bytes, memory->state().budgetBytes);
}

TEST_F(Residency, DoesNotEvictWhatIsLeased) {
    ResidencyManager manager(context(), provider_, 2 * kBytes);
    {
        const VolumeLease a = manager.acquire({"a", 0, 0, 0});
        const VolumeLease b = manager.acquire({"b", 0, 0, 0});
        EXPECT_THROW((void)manager.acquire({"c", 0, 0, 0}), LimitExceeded);
        EXPECT_TRUE(manager.isResident({"a", 0, 0, 0}));
        EXPECT_TRUE(manager.isResident({"b", 0, 0, 0}));
    }
    EXPECT_NO_THROW((void)manager.acquire({"c", 0, 0, 0}));
}

TEST_F(Residency, RefusesAVolumeBeyondTheBudgetAndKeepsTheRest) {
    addVolume(*provider_, "big", glm::ivec3(32), ScalarType::F32, ramp);
    ResidencyManager manager(context(), provider_, 2 * kBytes);
    (void)manager.acquire({"a", 0, 0, 0});
    EXPECT_THROW((void)manager.acquire({"big", 0, 0, 0}), LimitExceeded);
    EXPECT_TRUE(manager.isResident({"a", 0, 0, 0}));
    EXPECT_NO_THROW((void)manager.acquire({"big", 0, 0, 1})) << "a coarser level fits";
}

TEST_F(Residency, NamesWhatDoesNotExist) {
    ResidencyManager manager(context(), provider_, 2 * kBytes);
    EXPECT_THROW((void)manager.acquire({"nobody", 0, 0, 0}), NotFound);
    EXPECT_THROW((void)manager.acquire({"a", 1, 0, 0}), NotFound);
    EXPECT_THROW((void)manager.acquire({"a", 0, 0, 9}), NotFound);
    EXPECT_EQ(manager.state().textures, 0);
}

TEST_F(Residency, ForgetsADatasetButNotUnderALease) {
    ResidencyManager manager(context(), provider_, 10 * kBytes);
    (void)manager.acquire({"b", 0, 0, 0});
    {
        const VolumeLease lease = manager.acquire({"a", 0, 0, 0});
        manager.forget("a");
        EXPECT_EQ(readValues(lease.volume())[5], 5.0);
        EXPECT_FALSE(manager.isResident({"a", 0, 0, 0}));
        EXPECT_EQ(manager.state().residentBytes, kBytes);
        EXPECT_EQ(context().counts().textures, 2);
    }
    EXPECT_EQ(context().counts().textures, 1) << "freed with its lease";
    EXPECT_TRUE(manager.isResident({"b", 0, 0, 0}));
}

TEST_F(Residency, AFailedReadLeavesNothingBehind) {
    class Failing : public MemoryVolumeProvider {
    public:
        void readSlices(const VolumeKey& key, int zBegin, int zCount,
                        std::span<std::byte> out) const override {
            if (fail) throw IoError("a.raw", "it is shorter than its header says");
            MemoryVolumeProvider::readSlices(key, zBegin, zCount, out);
        }
        bool fail = true;
    };
    auto failing = std::make_shared<Failing>();
    addVolume(*failing, "a", glm::ivec3(kDim), ScalarType::F32, ramp);
    ResidencyManager manager(context(), failing, 2 * kBytes);
    EXPECT_THROW((void)manager.acquire({"a", 0, 0, 0}), IoError);
    EXPECT_EQ(manager.state().residentBytes, 0U);
    EXPECT_EQ(context().counts().textures, 0);
    failing->fail = false;
    EXPECT_NO_THROW((void)manager.acquire({"a", 0, 0, 0}));
}

struct TypeCase {
    ScalarType type;
    double low;
    double high;
};

class ResidencyTypes : public GlTest, public ::testing::WithParamInterface<TypeCase> {};

TEST_P(ResidencyTypes, TexelsGiveTheValuesBack) {
    const TypeCase& c = GetParam();
    // Odd sizes, more than one upload chunk is not needed for correctness of the arithmetic.
    const glm::ivec3 dims(7, 5, 9);
    const double step = (c.high - c.low) / static_cast<double>(sampleCount(dims));
    const auto value = [&](int x, int y, int z) {
        return std::floor(c.low + step * (x + 7.0 * (y + 5.0 * z)));
    };
    auto provider = std::make_shared<MemoryVolumeProvider>();
    addVolume(*provider, "v", dims, c.type, value, {true, false, false}, -0.5, 3.0);
    ResidencyManager manager(context(), provider, 1 << 20);
    const VolumeLease lease = manager.acquire({"v", 0, 0, 0});
    const auto values = readValues(lease.volume());
    const double tolerance = 0.5 * (c.high - c.low) * 1.2e-7 + 1e-9; // a float's precision over the range
    std::size_t i = 0;
    for (int z = 0; z < dims.z; ++z)
        for (int y = 0; y < dims.y; ++y)
            for (int x = 0; x < dims.x; ++x, ++i)
                ASSERT_NEAR(values[i], -0.5 * value(x, y, z) + 3.0, tolerance)
                    << scalarName(c.type) << " at " << i;

    GLint wrap = 0;
    glGetTextureParameteriv(lease.volume().texture->id(), GL_TEXTURE_WRAP_S, &wrap);
    EXPECT_EQ(wrap, GL_REPEAT);
    glGetTextureParameteriv(lease.volume().texture->id(), GL_TEXTURE_WRAP_T, &wrap);
    EXPECT_EQ(wrap, GL_CLAMP_TO_EDGE);
    ASSERT_NE(lease.volume().minMax, nullptr);
    EXPECT_EQ(lease.volume().minMax->bricks, MinMaxGrid::bricksFor(dims));
}

INSTANTIATE_TEST_SUITE_P(
    AllTypes, ResidencyTypes,
    ::testing::Values(TypeCase{ScalarType::U8, 0, 255}, TypeCase{ScalarType::I8, -128, 127},
                      TypeCase{ScalarType::U16, 0, 65535}, TypeCase{ScalarType::I16, -32768, 32767},
                      TypeCase{ScalarType::U32, 3e9, 4e9}, TypeCase{ScalarType::I32, -2e9, 2e9},
                      TypeCase{ScalarType::U64, 1e12, 2e12}, TypeCase{ScalarType::I64, -1e12, 1e12},
                      TypeCase{ScalarType::F32, -1e4, 1e4}, TypeCase{ScalarType::F64, 1e9, 1e9 + 1e4}),
    [](const auto& typeCase) { return std::string(scalarName(typeCase.param.type)); });

TEST_F(Residency, UploadsInChunksWithoutSeams) {
    // 300 x 300 slices of 4 bytes: 2 slices per 1 MiB chunk, so 100 slices take 50.
    const glm::ivec3 dims(300, 300, 100);
    const auto value = [](int x, int y, int z) { return x + 300.0 * (y + 7.0 * z); };
    addVolume(*provider_, "large", dims, ScalarType::I32, value);
    ResidencyManager manager(context(), provider_, 1 << 30);
    const VolumeLease lease = manager.acquire({"large", 0, 0, 0});
    const auto values = readValues(lease.volume());
    std::size_t i = 0;
    for (int z = 0; z < dims.z; ++z)
        for (int y = 0; y < dims.y; ++y)
            for (int x = 0; x < dims.x; ++x, ++i)
                ASSERT_NEAR(values[i], value(x, y, z), 0.05) << i;
}

TEST_F(Residency, GradientTexturesAreBuiltOnceCountedAndEvicted) {
    constexpr std::uint64_t gradientBytes = 2 * kBytes; // RGBA16F: 8 bytes for 4
    ResidencyManager manager(context(), provider_, 4 * kBytes);
    int built = 0;
    const auto build = [&](const ResidentVolume& volume, gpu::Texture& gradients, int zBegin, int zCount) {
        if (zBegin == 0) ++built;
        EXPECT_LE(zBegin + zCount, kDim);
        EXPECT_EQ(gradients.size(), volume.texture->size());
        EXPECT_EQ(gradients.internalFormat(), static_cast<GLenum>(GL_RGBA16F));
    };
    {
        const VolumeLease first = manager.acquireGradients({"a", 0, 0, 0}, FloatTexels::Full, build);
        const VolumeLease second = manager.acquireGradients({"a", 0, 0, 0}, FloatTexels::Full, build);
        EXPECT_EQ(first.volume().texture, second.volume().texture);
        EXPECT_NE(first.volume().texture, manager.acquire({"a", 0, 0, 0}).volume().texture);
    }
    EXPECT_EQ(built, 1);
    EXPECT_EQ(manager.state().residentBytes, kBytes + gradientBytes);
    EXPECT_EQ(manager.state().residentBytes, context().counts().textureBytes);
    EXPECT_EQ(manager.state().uploadedBytes, kBytes) << "gradients are not uploaded";
    (void)manager.acquireGradients({"b", 0, 0, 0}, FloatTexels::Full, build);
    EXPECT_LE(manager.state().residentBytes, 4 * kBytes);
    EXPECT_GT(manager.state().evictions, 0U);
    manager.forget("b");
    manager.forget("a");
    EXPECT_EQ(manager.state().residentBytes, 0U);
    ResidencyManager small(context(), provider_, kBytes + gradientBytes - 1);
    EXPECT_THROW((void)small.acquireGradients({"a", 0, 0, 0}, FloatTexels::Full, build), LimitExceeded);
}

TEST_F(Residency, HalfFloatTexturesStandBesideWholeOnes) {
    ResidencyManager manager(context(), provider_, 10 * kBytes);
    const VolumeLease whole = manager.acquire({"a", 0, 0, 0});
    const VolumeLease half = manager.acquire({"a", 0, 0, 0}, FloatTexels::Half);
    EXPECT_NE(whole.volume().texture, half.volume().texture);
    EXPECT_EQ(manager.state().residentBytes, kBytes + kBytes / 2);
    const auto exact = readValues(whole.volume());
    const auto rounded = readValues(half.volume());
    for (std::size_t i = 0; i < exact.size(); ++i)
        ASSERT_NEAR(rounded[i], exact[i], 4096.0 / 2 / 2048) << i;
    manager.forget("a");
    EXPECT_FALSE(manager.isResident({"a", 0, 0, 0}));
    EXPECT_FALSE(manager.isResident({"a", 0, 0, 0}, FloatTexels::Half));
}

} // namespace
} // namespace voxsheet
