// Blends the background under a drawn tile, flips its rows and packs it for the host.
#pragma once

#include "frame/frame_spec.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"

#include <cstddef>

namespace voxsheet {

[[nodiscard]] std::size_t pixelBytes(PixelFormat format) noexcept;

class TileResolver {
public:
    /// Throws GpuError if a program does not compile.
    explicit TileResolver(gpu::Context& context);

    /// Queues the work. `packed` holds at least width * height * pixelBytes(format) bytes.
    /// \param background  sRGB, not premultiplied
    void resolve(const gpu::Texture& drawn, const glm::vec4& background, PixelFormat format,
                 const gpu::Buffer& packed) const;

private:
    gpu::Context& context_;
    gpu::Program toRgba8_;
    gpu::Program toRgba32f_;
};

} // namespace voxsheet
