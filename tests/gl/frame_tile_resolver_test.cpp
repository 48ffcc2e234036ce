#include "frame/tile_resolver.h"

#include "frame/host_resolver.h"
#include "frame/target_pool.h"
#include "gl_fixture.h"
#include "gpu/pixel_readback.h"
#include "techniques/technique_set.h"

#include <cmath>
#include <cstring>
#include <random>
#include <span>

namespace voxsheet {
namespace {

using Resolver = GlTest;

/// Writes each texel's own coordinates, so that a misplaced row shows.
void writeCoordinates(gpu::Context& context, const gpu::Texture& texture) {
    static constexpr const char* kText = R"(#version 450 core
        layout(local_size_x = 8, local_size_y = 8) in;
        layout(rgba32f, binding = 0) writeonly uniform image2D target;
        void main() {
            ivec2 p = ivec2(gl_GlobalInvocationID.xy);
            imageStore(target, p, vec4(p, 7.0, 1.0)); // stores beyond the texture are dropped
        })";
    const EmbeddedFile files[] = {{"coordinates.glsl", kText, kText + std::strlen(kText)}};
    const auto program = gpu::Program::compute(context, gpu::expandShader(files, "coordinates.glsl"));
    texture.bindImage(0, GL_WRITE_ONLY);
    program.dispatch({(texture.size().x + 7) / 8, (texture.size().y + 7) / 8, 1});
    gpu::storageBarrier();
}

TEST_F(Resolver, PicturesLargerThanAStorageBlockComeInBands) {
    const glm::ivec2 size(2999, 2901);
    const std::size_t bytes = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 16;
    ASSERT_GT(bytes, std::size_t{1} << 27)
        << "above the least that OpenGL guarantees, which is llvmpipe's limit";
    const TileResolver resolver(context());
    const gpu::Texture drawn(context(), GL_TEXTURE_2D, GL_RGBA32F, {size, 1});
    writeCoordinates(context(), drawn);
    const gpu::Buffer packed(context(), bytes, 0);
    resolver.resolve(drawn, glm::vec4(1.0F), PixelFormat::Rgba32F, packed);
    gpu::PixelReadback readback(context(), bytes);
    readback.start(packed, bytes);
    const auto result = readback.finish();
    for (int y = 0; y < size.y; ++y) {
        for (const int x : {0, 1, size.x - 1}) {
            glm::vec4 pixel;
            const auto index =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
            std::memcpy(&pixel, result.data() + index * 16, 16);
            ASSERT_EQ(pixel, glm::vec4(x, size.y - 1 - y, 7, 1)) << x << ", " << y;
        }
    }
}

/// What the device makes of a picture that was drawn in host memory.
template <typename Value>
std::vector<Value> resolvedByTheDevice(gpu::Context& context, const std::vector<float>& drawn,
                                       glm::ivec2 size, const glm::vec4& background, PixelFormat format) {
    gpu::Texture texture(context, GL_TEXTURE_2D, GL_RGBA32F, {size, 1});
    texture.upload({0, 0, 0}, {size, 1}, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(drawn)));
    std::vector<Value> values(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4);
    const std::size_t bytes = values.size() * sizeof(Value);
    const gpu::Buffer packed(context, bytes, 0);
    TileResolver(context).resolve(texture, background, format, packed);
    gpu::PixelReadback readback(context, bytes);
    readback.start(packed, bytes);
    std::memcpy(values.data(), readback.finish().data(), bytes);
    return values;
}

TEST_F(Resolver, PicturesOfTheHostAreResolvedAsOnTheDevice) {
    const glm::ivec2 size(37, 23);
    const glm::vec4 background(0.2F, 0.6F, 0.9F, 0.7F);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<float> drawn;
    for (int pixel = 0; pixel < size.x * size.y; ++pixel) {
        const float alpha = uniform(random);
        for (int channel = 0; channel < 3; ++channel)
            drawn.push_back(alpha * uniform(random));
        drawn.push_back(alpha);
    }
    for (int channel = 0; channel < 3; ++channel)
        drawn[static_cast<std::size_t>(channel)] = 1.0F + 1e-6F; // light may exceed one by rounding
    const auto floats = resolvedByTheDevice<float>(context(), drawn, size, background, PixelFormat::Rgba32F);
    const auto ours = resolvedRgba32f(drawn, size, background);
    ASSERT_EQ(ours.size(), floats.size());
    for (std::size_t i = 0; i < floats.size(); ++i)
        ASSERT_NEAR(ours[i], floats[i], 2e-7) << i; // a fused multiply-add rounds once instead of twice
    const auto bytes =
        resolvedByTheDevice<unsigned char>(context(), drawn, size, background, PixelFormat::Rgba8);
    const auto ourBytes = resolvedRgba8(drawn, size, background);
    ASSERT_EQ(ourBytes.size(), bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const float exact = floats[i] * 255.0F;
        const bool tie = std::abs(exact - std::floor(exact) - 0.5F) < 1e-3F;
        ASSERT_NEAR(ourBytes[i], bytes[i], tie ? 1 : 0) << i << ": " << exact;
    }
}

TEST(HostResolver, BlendsUnderTheTopRowFirstAndRoundsToTheNearest) {
    // Two pixels, one above the other: clear below, half red above.
    const std::vector<float> drawn{0.0F, 0.0F, 0.0F, 0.0F, 0.5F, 0.0F, 0.0F, 0.5F};
    const auto bytes = resolvedRgba8(drawn, {1, 2}, glm::vec4(0.0F, 1.0F, 0.0F, 0.5F));
    EXPECT_EQ(bytes, (std::vector<unsigned char>{128, 64, 0, 191, 0, 128, 0, 128}));
    const auto clamped = resolvedRgba8({2.0F, -1.0F, 0.5F / 255.0F, 1.0F}, {1, 1}, glm::vec4(0.0F));
    EXPECT_EQ(clamped, (std::vector<unsigned char>{255, 0, 0, 255})) << "ties go to the even one";
}

TEST_F(Resolver, DrawingLeavesNoGlObjectsBehind) {
    auto provider = std::make_shared<MemoryVolumeProvider>();
    for (const char* key : {"a", "b"}) {
        addVolume(*provider, key, glm::ivec3(20), ScalarType::F32,
                  [](int x, int y, int z) { return x + y + z; });
    }
    const TileResolver resolver(context());
    TargetPool targets(context());
    ResidencyManager residency(context(), provider, 1 << 20);
    TechniqueSet techniques(context());
    for (int round = 0; round < 3; ++round) {
        for (const char* key : {"a", "b"}) {
            for (const Technique technique : {Technique::Raycast, Technique::Slices, Technique::Mip,
                                              Technique::Surface, Technique::Isosurface}) {
                TileSpec tile = frontTile(key, 20, 57.0, 16 + 8 * round);
                tile.technique = technique;
                tile.isosurface.surfaces = {{0.5, glm::vec4(1.0F)}};
                const TileVolumes volumes = techniques.acquire(residency, tile);
                techniques.draw(tile, volumes, targets.acquire(tile.sizePixels));
            }
        }
        residency.forget("a");
    }
    EXPECT_GT(context().counts().textures, 2);
    // Rays that SIMD kernels march read volumes in host memory, polygons textures.
    EXPECT_EQ(residency.state().textures, context().workarounds().simdRays ? 2 : 1);
    // TearDown finds every count at 0 once these are gone.
}

TEST_F(Resolver, TargetsAreReusedBySize) {
    TargetPool targets(context());
    const GLuint first = targets.acquire({64, 48}).id();
    (void)targets.acquire({32, 48});
    EXPECT_EQ(targets.acquire({64, 48}).id(), first);
    EXPECT_EQ(context().counts().textures, 2);
    // 2048 x 2048 takes 64 MiB: with another one in use, nothing else is kept.
    (void)targets.acquire({2048, 2048});
    (void)targets.acquire({2048, 2047});
    EXPECT_EQ(context().counts().textures, 2);
}

} // namespace
} // namespace voxsheet
