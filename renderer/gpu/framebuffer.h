// Framebuffers and vertex arrays for raster drawing.
#pragma once

#include "gpu/buffer.h"
#include "gpu/texture.h"

namespace voxsheet::gpu {

/// Draws into one colour texture and, optionally, one depth texture of the same size; both must outlive it.
class Framebuffer {
public:
    /// Throws GpuError when the combination is not complete.
    Framebuffer(Context& context, const Texture& colour, const Texture* depth = nullptr);
    Framebuffer(Framebuffer&&) noexcept = default;
    Framebuffer& operator=(Framebuffer&&) noexcept;
    ~Framebuffer();

    void bind() const; ///< for drawing, viewport = the whole texture
    /// As bind, and nothing outside of the rows [first, end), counted from the bottom, is cleared or drawn
    /// until unbind.
    void bindRows(int first, int end) const;
    static void unbind();

private:
    ObjectName name_;
    glm::ivec2 size_{0};
};

/// A vertex array; attributes are described once. One without attributes serves draws that use gl_VertexID
/// only.
class VertexArray {
public:
    explicit VertexArray(Context& context);
    VertexArray(VertexArray&&) noexcept = default;
    VertexArray& operator=(VertexArray&&) noexcept;
    ~VertexArray();

    /// Attribute `index`: `components` floats at `offsetBytes` of each vertex of `strideBytes`.
    void attribute(GLuint index, const Buffer& buffer, int components, std::size_t strideBytes,
                   std::size_t offsetBytes);
    void bind() const;

private:
    ObjectName name_;
};

} // namespace voxsheet::gpu
