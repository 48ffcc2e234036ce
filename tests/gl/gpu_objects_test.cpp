#include "base/errors.h"
#include "gl_fixture.h"
#include "gpu/framebuffer.h"
#include "gpu/pixel_readback.h"
#include "gpu/program.h"
#include "gpu/timer_query.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

namespace voxsheet::gpu {
namespace {

EmbeddedFile file(const char* path, const char* text) { return {path, text, text + std::strlen(text)}; }

ShaderText shader(const char* text) {
    const EmbeddedFile files[] = {file("test.glsl", text)};
    return expandShader(files, "test.glsl");
}

constexpr const char* kCopyShader = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D source;
layout(std430, binding = 0) writeonly buffer Out { vec4 texels[]; };
uniform ivec2 size;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x < size.x && p.y < size.y) texels[p.y * size.x + p.x] = texelFetch(source, p, 0);
})";

/// A 2D texture's texels, through the path that frames take.
std::vector<glm::vec4> readTexture(Context& context, const Texture& texture) {
    const glm::ivec2 size(texture.size());
    const auto count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    const Program program = Program::compute(context, shader(kCopyShader));
    const Buffer out(context, count * sizeof(glm::vec4), 0);
    PixelReadback readback(context, out.bytes());
    context.settleRaster();
    storageBarrier();
    texture.bind(0);
    out.bindStorage(0);
    program.set("size", size);
    program.dispatch({(size.x + 7) / 8, (size.y + 7) / 8, 1});
    storageBarrier();
    readback.start(out, out.bytes());
    std::vector<glm::vec4> texels(count);
    std::memcpy(texels.data(), readback.finish().data(), out.bytes());
    return texels;
}

using GpuObjects = GlTest;

TEST_F(GpuObjects, TheDeviceIsDescribed) {
    const RenderDevice& device = context().device();
    EXPECT_FALSE(device.renderer.empty());
    EXPECT_FALSE(device.eglPlatform.empty());
    EXPECT_EQ(device.reason.back(), '.') << device.reason;
    EXPECT_GE(device.maxTextureSize3d, 2048) << "the least that OpenGL 4.5 allows";
    EXPECT_GT(device.textureBudgetBytes, std::uint64_t{1} << 26);
}

TEST_F(GpuObjects, ADeviceIsChosenByItsIndex) {
    const auto devices = listRenderDevices();
    ASSERT_FALSE(devices.empty());
    std::size_t usable = 0;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (devices[i].find("not usable") != std::string::npos) continue;
        ++usable;
        const Context chosen(static_cast<int>(i));
        EXPECT_NE(devices[i].find(chosen.device().renderer), std::string::npos) << devices[i];
        EXPECT_NE(devices[i].find(chosen.device().eglPlatform), std::string::npos) << devices[i];
    }
    EXPECT_GE(usable, 1U);
    context().makeCurrent();
    EXPECT_THROW(Context(static_cast<int>(devices.size())), InvalidInput);
}

TEST_F(GpuObjects, AnotherContextComesAndGoesWithoutHarm) {
    const Texture texture(context(), GL_TEXTURE_2D, GL_RGBA32F, {4, 4, 1});
    std::thread([] { const Context other; }).join();
    std::thread([] { const Context other; }).join();
    const Texture after(context(), GL_TEXTURE_2D, GL_RGBA32F, {4, 4, 1});
    EXPECT_EQ(context().counts().textures, 2);
}

TEST_F(GpuObjects, BytesAreCountedExactly) {
    {
        const Texture volume(context(), GL_TEXTURE_3D, GL_R16, {5, 6, 7});
        Texture table(context(), GL_TEXTURE_1D, GL_RGBA32F, {16, 1, 1});
        const Buffer buffer(context(), 100);
        EXPECT_EQ(context().counts().textureBytes, 5U * 6U * 7U * 2U + 16U * 16U);
        EXPECT_EQ(context().counts().bufferBytes, 100U);
        Texture moved = std::move(table);
        moved = Texture(context(), GL_TEXTURE_2D, GL_R8, {3, 3, 1});
        EXPECT_EQ(context().counts().textureBytes, 420U + 9U);
        EXPECT_EQ(context().counts().textures, 2);
    }
    EXPECT_EQ(context().counts(), ObjectCounts{});
}

TEST_F(GpuObjects, TexturesRefuseWhatTheDeviceCannotHold) {
    const int beyond = context().limits().textureSize3d + 1;
    EXPECT_THROW(Texture(context(), GL_TEXTURE_3D, GL_R8, {beyond, 1, 1}), LimitExceeded);
    EXPECT_THROW(Texture(context(), GL_TEXTURE_2D, GL_R8, {4, 0, 1}), InternalError);
    Texture small(context(), GL_TEXTURE_2D, GL_R8, {4, 4, 1});
    const std::vector<std::byte> tooFew(15);
    EXPECT_THROW(small.upload({0, 0, 0}, {4, 4, 1}, GL_RED, GL_UNSIGNED_BYTE, tooFew), InternalError);
    const std::vector<std::byte> beside(16);
    EXPECT_THROW(small.upload({1, 0, 0}, {4, 4, 1}, GL_RED, GL_UNSIGNED_BYTE, beside), GpuError);
}

TEST_F(GpuObjects, UploadsOddSizesAndReadsThemBack) {
    Texture texture(context(), GL_TEXTURE_2D, GL_R8, {5, 3, 1}); // rows of 5 bytes: tight packing matters
    std::vector<std::byte> bytes(15);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i * 17);
    texture.upload({0, 0, 0}, {5, 3, 1}, GL_RED, GL_UNSIGNED_BYTE, bytes);
    const auto texels = readTexture(context(), texture);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        EXPECT_NEAR(texels[i].x, static_cast<float>(i * 17) / 255.0F, 1e-6F) << i;
    }
}

TEST_F(GpuObjects, AClearIsDoneBeforeTheComputeDispatchThatFollows) {
    // On llvmpipe a queued framebuffer clear can run after the dispatch: a fault of the driver.
    const Program program = Program::compute(context(), shader(R"(#version 450 core
        layout(local_size_x = 1) in;
        layout(rgba32f, binding = 0) writeonly uniform image2D target;
        void main() { imageStore(target, ivec2(gl_GlobalInvocationID.xy), vec4(1.0, 2.0, 3.0, 4.0)); })"));
    for (int round = 0; round < 20; ++round) {
        Texture texture(context(), GL_TEXTURE_2D, GL_RGBA32F, {64, 64, 1});
        if (round % 2 == 0) {
            texture.clear(glm::vec4(0.25F));
        } else {
            const Framebuffer framebuffer(context(), texture);
            framebuffer.bind();
            glClearColor(0.25F, 0.25F, 0.25F, 0.25F);
            glClear(GL_COLOR_BUFFER_BIT);
            Framebuffer::unbind();
            context().settleRaster();
        }
        texture.bindImage(0, GL_WRITE_ONLY);
        program.dispatch({64, 32, 1});
        const auto texels = readTexture(context(), texture);
        ASSERT_EQ(texels[0], glm::vec4(1.0F, 2.0F, 3.0F, 4.0F)) << "round " << round;
        ASSERT_EQ(texels[64 * 64 - 1], glm::vec4(0.25F)) << "round " << round;
    }
}

TEST_F(GpuObjects, RasterDrawsReachTheTexture) {
    const Program program = Program::graphics(context(), shader(R"(#version 450 core
            layout(location = 0) in vec2 corner;
            void main() { gl_Position = vec4(corner, 0.0, 1.0); })"),
                                              shader(R"(#version 450 core
            uniform vec4 colour;
            layout(location = 0) out vec4 result;
            void main() { result = colour; })"));
    const Texture texture(context(), GL_TEXTURE_2D, GL_RGBA32F, {32, 32, 1});
    const Framebuffer framebuffer(context(), texture);
    const float corners[] = {-1, -1, 3, -1, -1, 3};
    const Buffer vertices(context(), sizeof corners, 0, corners);
    VertexArray layout(context());
    layout.attribute(0, vertices, 2, 2 * sizeof(float), 0);
    program.set("colour", glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    framebuffer.bind();
    layout.bind();
    program.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    Framebuffer::unbind();
    for (const glm::vec4& texel : readTexture(context(), texture)) {
        ASSERT_EQ(texel, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    }
}

TEST_F(GpuObjects, ShaderErrorsNameFileAndLine) {
    const EmbeddedFile files[] = {
        file("main.glsl",
             "#version 450 core\nlayout(local_size_x = 1) in;\n#include \"part.glsl\"\nvoid main() {}\n"),
        file("part.glsl", "float fine;\nfloat broken = undeclared;\n"),
    };
    try {
        (void)Program::compute(context(), expandShader(files, "main.glsl"));
        FAIL() << "it must not compile";
    } catch (const GpuError& error) {
        EXPECT_NE(std::string(error.what()).find("part.glsl:2:"), std::string::npos) << error.what();
    }
}

TEST_F(GpuObjects, TimestampsAgreeWithTheHostsClock) {
    // Enough arithmetic for some ten milliseconds on two slow cores, in a loop that cannot be folded away.
    const Program program = Program::compute(context(), shader(R"(#version 450 core
        layout(local_size_x = 64) in;
        layout(std430, binding = 0) buffer Out { float values[]; };
        uniform int rounds;
        void main() {
            float x = float(gl_GlobalInvocationID.x) * 1e-6;
            for (int i = 0; i < rounds; ++i) x = fract(x * 1.7 + 0.3);
            values[gl_GlobalInvocationID.x] = x;
        })"));
    const Buffer out(context(), 65536 * sizeof(float), 0);
    out.bindStorage(0);
    TimerQuery timer(context());
    const auto measure = [&](int rounds) {
        program.set("rounds", rounds);
        glFinish();
        const auto begun = std::chrono::steady_clock::now();
        timer.begin();
        program.dispatch({1024, 1, 1});
        timer.end();
        glFinish();
        const double wallMs =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
        return std::pair(timer.milliseconds(), wallMs);
    };
    (void)measure(10); // compiles
    // Software draws on the caller's cores, so the dispatch is nearly all of the time; other programs may
    // come between the two clocks, hence several tries.
    double bestShare = 0.0;
    for (int attempt = 0; attempt < 5; ++attempt) {
        const auto [gpuMs, wallMs] = measure(3000);
        EXPECT_GT(gpuMs, 0.0);
        EXPECT_LE(gpuMs, wallMs + 1.0);
        bestShare = std::max(bestShare, gpuMs / wallMs);
    }
    if (context().device().software) {
        EXPECT_GT(bestShare, 0.5);
    }
    EXPECT_TRUE(timer.tryMilliseconds().has_value());
}

TEST_F(GpuObjects, ReadbackRefusesMisuse) {
    const Buffer source(context(), 64);
    PixelReadback readback(context(), 32);
    EXPECT_THROW(readback.start(source, 64), InternalError);
    readback.start(source, 32);
    EXPECT_THROW(readback.start(source, 16), InternalError);
    EXPECT_EQ(readback.finish().size(), 32U);
    EXPECT_TRUE(readback.ready());
}

} // namespace
} // namespace voxsheet::gpu
