// A buffer object with immutable storage.
#pragma once

#include "gpu/object_name.h"

#include <cstddef>
#include <span>

namespace voxsheet::gpu {

class Buffer {
public:
    /// \param bytes  > 0
    /// \param flags  of glNamedBufferStorage; GL_DYNAMIC_STORAGE_BIT allows upload()
    /// Throws LimitExceeded when the device has no memory for it.
    Buffer(Context& context, std::size_t bytes, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT,
           const void* data = nullptr);
    Buffer(Buffer&&) noexcept = default;
    Buffer& operator=(Buffer&&) noexcept;
    ~Buffer();

    void upload(std::size_t offset, std::span<const std::byte> data);
    void bindStorage(GLuint index) const; ///< whole buffer, as shader storage block `index`
    void bindUniform(GLuint index) const; ///< whole buffer, as uniform block `index`
    /// Bytes [offset, offset + bytes) as storage block; offset is a multiple of 256.
    void bindStorageRange(GLuint index, std::size_t offset, std::size_t bytes) const;

    [[nodiscard]] GLuint id() const { return name_.id(); }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

private:
    ObjectName name_;
    std::size_t bytes_ = 0;
};

} // namespace voxsheet::gpu
