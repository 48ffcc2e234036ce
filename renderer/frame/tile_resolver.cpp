#include "frame/tile_resolver.h"

#include "gpu/context.h"
#include "stages/shader_files.h"

#include <algorithm>

namespace voxsheet {

namespace {

constexpr int kGroupPixels = 16;
/// Bands begin at multiples of this, so that their byte offsets are multiples of 256 whatever the width.
constexpr int kBandRows = 64;

gpu::Program makeProgram(gpu::Context& context, const gpu::ShaderDefines& defines) {
    return gpu::Program::compute(context,
                                 gpu::expandShader(embeddedShaders(), "frame/resolve.glsl", defines));
}

/// Rows that fit into one storage block of the device.
int rowsPerDispatch(const gpu::Context& context, std::size_t rowBytes) {
    const auto limit =
        static_cast<std::size_t>(std::max<std::int64_t>(context.limits().storageBlockBytes, 0));
    const std::size_t bands = std::max<std::size_t>(limit / (rowBytes * kBandRows), 1);
    return static_cast<int>(std::min<std::size_t>(bands, 1024)) * kBandRows;
}

} // namespace

std::size_t pixelBytes(PixelFormat format) noexcept { return format == PixelFormat::Rgba8 ? 4 : 16; }

TileResolver::TileResolver(gpu::Context& context)
    : context_(context), toRgba8_(makeProgram(context, {{"PACK_RGBA8", "1"}})),
      toRgba32f_(makeProgram(context, {})) {}

void TileResolver::resolve(const gpu::Texture& drawn, const glm::vec4& background, PixelFormat format,
                           const gpu::Buffer& packed) const {
    const gpu::Program& program = format == PixelFormat::Rgba8 ? toRgba8_ : toRgba32f_;
    const glm::ivec2 size(drawn.size().x, drawn.size().y);
    const std::size_t rowBytes = static_cast<std::size_t>(size.x) * pixelBytes(format);
    const int step = rowsPerDispatch(context_, rowBytes);

    context_.settleRaster();
    gpu::storageBarrier(); // a technique may have written by image stores
    drawn.bind(0);
    gpu::Sampler::unbind(0);
    program.set("sizePixels", size);
    program.set("background", glm::vec4(glm::vec3(background) * background.w, background.w));
    for (int row = 0; row < size.y; row += step) {
        const int end = std::min(row + step, size.y);
        packed.bindStorageRange(0, static_cast<std::size_t>(row) * rowBytes,
                                static_cast<std::size_t>(end - row) * rowBytes);
        program.set("rows", glm::ivec2(row, end));
        program.dispatch(
            {(size.x + kGroupPixels - 1) / kGroupPixels, (end - row + kGroupPixels - 1) / kGroupPixels, 1});
    }
    gpu::storageBarrier();
}

} // namespace voxsheet
