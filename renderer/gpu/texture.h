// A 1D, 2D or 3D texture with immutable storage and one level, and samplers.
#pragma once

#include "gpu/object_name.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace voxsheet::gpu {

/// Bytes of one texel. Throws InternalError for a format that this program does not use.
[[nodiscard]] std::size_t texelBytes(GLenum internalFormat);

class Texture {
public:
    /// \param target          GL_TEXTURE_1D, _2D or _3D
    /// \param internalFormat  sized: GL_R8, GL_R16, GL_R32F, GL_RG32F, GL_RGBA8, GL_RGBA16F, GL_RGBA32F,
    /// GL_R32UI, GL_R8UI,
    ///                        GL_R32I, GL_R16F, GL_RG16F, GL_DEPTH_COMPONENT32F
    /// \param size            texels per axis; 1 on the axes that the target lacks
    /// Filter: nearest; wrap: clamp to edge. Contents undefined.
    /// Throws LimitExceeded for a size beyond the device's limits or memory.
    Texture(Context& context, GLenum target, GLenum internalFormat, glm::ivec3 size);
    Texture(Texture&&) noexcept = default;
    Texture& operator=(Texture&&) noexcept;
    ~Texture();

    void setFilter(GLenum filter);                          ///< GL_NEAREST or GL_LINEAR, both ways
    void setWrap(GLenum wrapS, GLenum wrapT, GLenum wrapR); ///< GL_CLAMP_TO_EDGE, GL_REPEAT, …

    /// Copies texels into the box [offset, offset + extent), tightly packed, x fastest. `format` and `type`
    /// as in glTexSubImage3D must name the layout of the internal format itself: texels.size() =
    /// product(extent) * texelBytes().
    void upload(glm::ivec3 offset, glm::ivec3 extent, GLenum format, GLenum type,
                std::span<const std::byte> texels) const;
    /// Copies rows [firstRow, endRow) of a 2D texture here, tightly packed as for upload; waits for what
    /// draws it.
    void download(int firstRow, int endRow, GLenum format, GLenum type, std::span<std::byte> texels) const;
    /// Sets all texels of a float or normalised colour texture; safe before a compute dispatch writes it.
    void clear(const glm::vec4& value);

    void bind(GLuint unit) const;                     ///< for sampling
    void bindImage(GLuint unit, GLenum access) const; ///< for image load/store, all layers

    [[nodiscard]] GLuint id() const { return name_.id(); }
    [[nodiscard]] GLenum target() const { return target_; }
    [[nodiscard]] GLenum internalFormat() const { return internalFormat_; }
    [[nodiscard]] glm::ivec3 size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; } ///< product of size() times texelBytes()

private:
    ObjectName name_;
    GLenum target_ = 0;
    GLenum internalFormat_ = 0;
    glm::ivec3 size_{0};
    std::size_t bytes_ = 0;
};

struct SamplerSpec {
    GLenum filter = GL_LINEAR;
    GLenum wrapS = GL_CLAMP_TO_EDGE;
    GLenum wrapT = GL_CLAMP_TO_EDGE;
    GLenum wrapR = GL_CLAMP_TO_EDGE;
};

/// Overrides the filter and wrap of the texture that is bound to the same unit, until unbound.
class Sampler {
public:
    Sampler(Context& context, const SamplerSpec& spec);
    Sampler(Sampler&&) noexcept = default;
    Sampler& operator=(Sampler&&) noexcept;
    ~Sampler();

    void bind(GLuint unit) const;
    static void unbind(GLuint unit);

private:
    ObjectName name_;
};

} // namespace voxsheet::gpu
