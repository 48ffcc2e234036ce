#include "gpu/buffer.h"

#include "base/errors.h"
#include "gpu/context.h"

#include <string>

namespace voxsheet::gpu {

namespace {

std::string describe(std::size_t bytes) { return "a buffer of " + std::to_string(bytes) + " bytes"; }

GLuint createBuffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return id;
}

} // namespace

Buffer::Buffer(Context& context, std::size_t bytes, GLbitfield flags, const void* data) : bytes_(bytes) {
    if (bytes == 0) throw InternalError("a GPU buffer", "its size is 0");
    const GLuint id = createBuffer();
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), data, flags);
    try {
        context.checkErrors("making " + describe(bytes));
    } catch (...) {
        glDeleteBuffers(1, &id);
        throw;
    }
    name_ = ObjectName(context, id);
    ++context.mutableCounts().buffers;
    context.mutableCounts().bufferBytes += bytes;
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

Buffer::~Buffer() {
    if (!name_) return;
    const GLuint id = name_.id();
    glDeleteBuffers(1, &id);
    --name_.context().mutableCounts().buffers;
    name_.context().mutableCounts().bufferBytes -= bytes_;
}

void Buffer::upload(std::size_t offset, std::span<const std::byte> data) {
    if (offset > bytes_ || data.size() > bytes_ - offset) {
        throw InternalError("upload into " + describe(bytes_), "the data reach beyond its end");
    }
    if (data.empty()) return;
    glNamedBufferSubData(name_.id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()),
                         data.data());
    name_.context().checkErrors("upload into " + describe(bytes_));
}

void Buffer::bindStorage(GLuint index) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, index, name_.id());
}

void Buffer::bindUniform(GLuint index) const { glBindBufferBase(GL_UNIFORM_BUFFER, index, name_.id()); }

void Buffer::bindStorageRange(GLuint index, std::size_t offset, std::size_t bytes) const {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, index, name_.id(), static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(bytes));
}

} // namespace voxsheet::gpu
