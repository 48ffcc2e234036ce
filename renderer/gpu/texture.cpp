#include "gpu/texture.h"

#include "base/errors.h"
#include "gpu/context.h"

#include <algorithm>
#include <string>

namespace voxsheet::gpu {

namespace {

int axesOf(GLenum target) {
    switch (target) {
    case GL_TEXTURE_1D:
        return 1;
    case GL_TEXTURE_2D:
        return 2;
    case GL_TEXTURE_3D:
        return 3;
    default:
        throw InternalError("a texture", "only 1D, 2D and 3D targets are in use");
    }
}

std::string describe(int axes, glm::ivec3 size) {
    std::string text = "a texture of " + std::to_string(size.x);
    for (int axis = 1; axis < axes; ++axis)
        text += " x " + std::to_string(size[axis]);
    return text + " texels";
}

void checkSize(const Context& context, int axes, glm::ivec3 size) {
    const int limit = axes == 3 ? context.limits().textureSize3d : context.limits().textureSize2d;
    for (int axis = 0; axis < 3; ++axis) {
        const int most = axis < axes ? limit : 1;
        if (size[axis] < 1) throw InternalError(describe(axes, size), "every axis must have a texel");
        if (size[axis] > most) {
            throw LimitExceeded(describe(axes, size),
                                "this device takes at most " + std::to_string(limit) + " texels per axis",
                                "draw a coarser level or a smaller picture");
        }
    }
}

void allocate(GLuint id, int axes, GLenum format, glm::ivec3 size) {
    if (axes == 1) glTextureStorage1D(id, 1, format, size.x);
    if (axes == 2) glTextureStorage2D(id, 1, format, size.x, size.y);
    if (axes == 3) glTextureStorage3D(id, 1, format, size.x, size.y, size.z);
}

GLint asParameter(GLenum value) { return static_cast<GLint>(value); }

} // namespace

std::size_t texelBytes(GLenum internalFormat) {
    switch (internalFormat) {
    case GL_R8:
    case GL_R8UI:
        return 1;
    case GL_R16:
    case GL_R16F:
        return 2;
    case GL_R32F:
    case GL_R32UI:
    case GL_R32I:
    case GL_RG16F:
    case GL_RGBA8:
    case GL_DEPTH_COMPONENT32F:
        return 4;
    case GL_RG32F:
    case GL_RGBA16F:
        return 8;
    case GL_RGBA32F:
        return 16;
    default:
        throw InternalError("a texture", "format " + std::to_string(internalFormat) + " is not in use");
    }
}

Texture::Texture(Context& context, GLenum target, GLenum internalFormat, glm::ivec3 size)
    : target_(target), internalFormat_(internalFormat), size_(size) {
    const int axes = axesOf(target);
    checkSize(context, axes, size);
    bytes_ = texelBytes(internalFormat) * static_cast<std::size_t>(size.x) *
             static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    allocate(id, axes, internalFormat, size);
    try {
        context.checkErrors("making " + describe(axes, size));
    } catch (...) {
        glDeleteTextures(1, &id);
        throw;
    }
    name_ = ObjectName(context, id);
    ++context.mutableCounts().textures;
    context.mutableCounts().textureBytes += bytes_;
    setFilter(GL_NEAREST);
    setWrap(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(target_, other.target_);
    std::swap(internalFormat_, other.internalFormat_);
    std::swap(size_, other.size_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

Texture::~Texture() {
    if (!name_) return;
    const GLuint id = name_.id();
    glDeleteTextures(1, &id);
    --name_.context().mutableCounts().textures;
    name_.context().mutableCounts().textureBytes -= bytes_;
}

void Texture::setFilter(GLenum filter) {
    glTextureParameteri(name_.id(), GL_TEXTURE_MIN_FILTER, asParameter(filter));
    glTextureParameteri(name_.id(), GL_TEXTURE_MAG_FILTER, asParameter(filter));
}

void Texture::setWrap(GLenum wrapS, GLenum wrapT, GLenum wrapR) {
    glTextureParameteri(name_.id(), GL_TEXTURE_WRAP_S, asParameter(wrapS));
    glTextureParameteri(name_.id(), GL_TEXTURE_WRAP_T, asParameter(wrapT));
    glTextureParameteri(name_.id(), GL_TEXTURE_WRAP_R, asParameter(wrapR));
}

void Texture::upload(glm::ivec3 offset, glm::ivec3 extent, GLenum format, GLenum type,
                     std::span<const std::byte> texels) const {
    const int axes = axesOf(target_);
    const std::size_t count = static_cast<std::size_t>(extent.x) * static_cast<std::size_t>(extent.y) *
                              static_cast<std::size_t>(extent.z);
    // Formats are uploaded in their own layout, so the size is known; anything else would read past the end.
    if (texels.size() != count * texelBytes(internalFormat_)) {
        throw InternalError("upload into " + describe(axes, size_),
                            "the data do not have the size of the box");
    }
    const GLuint id = name_.id();
    if (axes == 1) glTextureSubImage1D(id, 0, offset.x, extent.x, format, type, texels.data());
    if (axes == 2) {
        glTextureSubImage2D(id, 0, offset.x, offset.y, extent.x, extent.y, format, type, texels.data());
    }
    if (axes == 3) {
        glTextureSubImage3D(id, 0, offset.x, offset.y, offset.z, extent.x, extent.y, extent.z, format, type,
                            texels.data());
    }
    name_.context().checkErrors("upload into " + describe(axes, size_));
}

void Texture::download(int firstRow, int endRow, GLenum format, GLenum type,
                       std::span<std::byte> texels) const {
    glGetTextureSubImage(name_.id(), 0, 0, firstRow, 0, size_.x, endRow - firstRow, 1, format, type,
                         static_cast<GLsizei>(texels.size()), texels.data());
    name_.context().checkErrors("reading " + describe(axesOf(target_), size_));
}

void Texture::clear(const glm::vec4& value) {
    glClearTexImage(name_.id(), 0, GL_RGBA, GL_FLOAT, &value[0]);
    name_.context().checkErrors("clearing " + describe(axesOf(target_), size_));
    name_.context().settleRaster();
}

void Texture::bind(GLuint unit) const { glBindTextureUnit(unit, name_.id()); }

void Texture::bindImage(GLuint unit, GLenum access) const {
    glBindImageTexture(unit, name_.id(), 0, target_ == GL_TEXTURE_3D ? GL_TRUE : GL_FALSE, 0, access,
                       internalFormat_);
}

Sampler::Sampler(Context& context, const SamplerSpec& spec) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    name_ = ObjectName(context, id);
    ++context.mutableCounts().samplers;
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, asParameter(spec.filter));
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, asParameter(spec.filter));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, asParameter(spec.wrapS));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, asParameter(spec.wrapT));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_R, asParameter(spec.wrapR));
    context.checkErrors("making a sampler");
}

Sampler& Sampler::operator=(Sampler&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

Sampler::~Sampler() {
    if (!name_) return;
    const GLuint id = name_.id();
    glDeleteSamplers(1, &id);
    --name_.context().mutableCounts().samplers;
}

void Sampler::bind(GLuint unit) const { glBindSampler(unit, name_.id()); }
void Sampler::unbind(GLuint unit) { glBindSampler(unit, 0); }

} // namespace voxsheet::gpu
