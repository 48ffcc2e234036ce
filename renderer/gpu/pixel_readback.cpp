#include "gpu/pixel_readback.h"

#include "base/errors.h"
#include "gpu/context.h"

#include <utility>

namespace voxsheet::gpu {

namespace {

constexpr GLbitfield kMapping = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
constexpr GLuint64 kWaitNs = 100'000'000; ///< between looks at the device's health

} // namespace

PixelReadback::PixelReadback(Context& context, std::size_t capacityBytes)
    : context_(&context), buffer_(context, capacityBytes, kMapping | GL_CLIENT_STORAGE_BIT) {
    mapped_ = static_cast<const std::byte*>(
        glMapNamedBufferRange(buffer_.id(), 0, static_cast<GLsizeiptr>(capacityBytes), kMapping));
    context.checkErrors("mapping a readback buffer");
    if (mapped_ == nullptr) throw GpuError("a readback buffer", "it cannot be mapped");
}

PixelReadback::PixelReadback(PixelReadback&& other) noexcept
    : context_(other.context_), buffer_(std::move(other.buffer_)),
      mapped_(std::exchange(other.mapped_, nullptr)), fence_(std::exchange(other.fence_, nullptr)),
      pendingBytes_(std::exchange(other.pendingBytes_, 0U)) {}

PixelReadback& PixelReadback::operator=(PixelReadback&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(buffer_, other.buffer_);
    std::swap(mapped_, other.mapped_);
    std::swap(fence_, other.fence_);
    std::swap(pendingBytes_, other.pendingBytes_);
    return *this;
}

PixelReadback::~PixelReadback() { dropFence(); }

void PixelReadback::start(const Buffer& source, std::size_t bytes) {
    if (bytes > capacityBytes() || bytes > source.bytes()) {
        throw InternalError("a readback", "it is larger than its buffers");
    }
    if (fence_ != nullptr) throw InternalError("a readback", "another one is on its way");
    glCopyNamedBufferSubData(source.id(), buffer_.id(), 0, 0, static_cast<GLsizeiptr>(bytes));
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    pendingBytes_ = bytes;
    glFlush(); // or the fence might never be passed while we look at ready() only
    context_->checkErrors("starting a readback");
}

bool PixelReadback::ready() const {
    if (fence_ == nullptr) return true;
    GLint status = GL_UNSIGNALED;
    glGetSynciv(fence_, GL_SYNC_STATUS, 1, nullptr, &status);
    return status == GL_SIGNALED;
}

std::span<const std::byte> PixelReadback::finish() {
    while (fence_ != nullptr) {
        const GLenum status = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kWaitNs);
        if (status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED) {
            dropFence();
        } else if (status == GL_WAIT_FAILED) {
            dropFence();
            context_->checkReset();
            context_->checkErrors("waiting for pixels");
            throw GpuError("waiting for pixels", "the driver gave up");
        } else {
            context_->checkReset();
        }
    }
    return {mapped_, pendingBytes_};
}

void PixelReadback::dropFence() noexcept {
    if (fence_ != nullptr) glDeleteSync(fence_);
    fence_ = nullptr;
}

} // namespace voxsheet::gpu
