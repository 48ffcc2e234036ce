// Bytes on their way from the GPU to the host, without stalling the commands that follow.
#pragma once

#include "gpu/buffer.h"

#include <cstddef>
#include <span>

namespace voxsheet::gpu {

class PixelReadback {
public:
    /// A persistently mapped host buffer of `capacityBytes` > 0. Throws LimitExceeded without memory.
    PixelReadback(Context& context, std::size_t capacityBytes);
    PixelReadback(PixelReadback&&) noexcept;
    PixelReadback& operator=(PixelReadback&&) noexcept;
    ~PixelReadback();

    /// Queues a copy of the first `bytes` <= capacity of `source`, and a fence. Shader writes to `source`
    /// must have had their barrier. Nothing else may be on its way.
    void start(const Buffer& source, std::size_t bytes);
    [[nodiscard]] bool ready() const; ///< finish() would not wait
    /// Waits for the copy and returns the bytes, valid until the next start(). Throws GpuError if the device
    /// was lost.
    [[nodiscard]] std::span<const std::byte> finish();

    [[nodiscard]] std::size_t capacityBytes() const { return buffer_.bytes(); }

private:
    void dropFence() noexcept;

    Context* context_ = nullptr;
    Buffer buffer_;
    const std::byte* mapped_ = nullptr;
    GLsync fence_ = nullptr;
    std::size_t pendingBytes_ = 0;
};

} // namespace voxsheet::gpu
