#include "gpu/framebuffer.h"

#include "base/errors.h"
#include "gpu/context.h"

namespace voxsheet::gpu {

Framebuffer::Framebuffer(Context& context, const Texture& colour, const Texture* depth)
    : size_(colour.size().x, colour.size().y) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    name_ = ObjectName(context, id);
    ++context.mutableCounts().framebuffers;
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, colour.id(), 0);
    if (depth != nullptr) glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth->id(), 0);
    if (glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        glDeleteFramebuffers(1, &id);
        --context.mutableCounts().framebuffers;
        throw GpuError("a framebuffer", "this device cannot draw into its formats");
    }
    context.checkErrors("making a framebuffer");
}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    return *this;
}

Framebuffer::~Framebuffer() {
    if (!name_) return;
    const GLuint id = name_.id();
    glDeleteFramebuffers(1, &id);
    --name_.context().mutableCounts().framebuffers;
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, name_.id());
    glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::bindRows(int first, int end) const {
    bind();
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, first, size_.x, end - first);
}

void Framebuffer::unbind() {
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

VertexArray::VertexArray(Context& context) {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    name_ = ObjectName(context, id);
    ++context.mutableCounts().vertexArrays;
    context.checkErrors("making a vertex array");
}

VertexArray& VertexArray::operator=(VertexArray&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

VertexArray::~VertexArray() {
    if (!name_) return;
    const GLuint id = name_.id();
    glDeleteVertexArrays(1, &id);
    --name_.context().mutableCounts().vertexArrays;
}

void VertexArray::attribute(GLuint index, const Buffer& buffer, int components, std::size_t strideBytes,
                            std::size_t offsetBytes) {
    const GLuint id = name_.id();
    glEnableVertexArrayAttrib(id, index);
    glVertexArrayVertexBuffer(id, index, buffer.id(), static_cast<GLintptr>(offsetBytes),
                              static_cast<GLsizei>(strideBytes));
    glVertexArrayAttribFormat(id, index, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(id, index, index);
    name_.context().checkErrors("describing a vertex attribute");
}

void VertexArray::bind() const { glBindVertexArray(name_.id()); }

} // namespace voxsheet::gpu
