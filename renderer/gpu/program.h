// A linked shader program and its uniforms.
#pragma once

#include "gpu/object_name.h"
#include "gpu/shader_source.h"

#include <glm/glm.hpp>

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace voxsheet::gpu {

class Program {
public:
    /// Throw GpuError with the driver's messages as `file:line: text` when a shader does not compile or link.
    [[nodiscard]] static Program compute(Context& context, const ShaderText& shader);
    [[nodiscard]] static Program graphics(Context& context, const ShaderText& vertex,
                                          const ShaderText& fragment);

    Program(Program&&) noexcept = default;
    Program& operator=(Program&&) noexcept;
    ~Program();

    void use() const;
    /// use() and dispatch this many groups. A barrier is the caller's: see storageBarrier().
    void dispatch(glm::ivec3 groups) const;

    /// Sets a uniform. One that the compiler removed, or that does not exist, is ignored, as in
    /// glProgramUniform.
    void set(const char* name, int value) const;
    void set(const char* name, unsigned value) const;
    void set(const char* name, float value) const;
    void set(const char* name, const glm::vec2& value) const;
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::vec4& value) const;
    void set(const char* name, const glm::ivec2& value) const;
    void set(const char* name, const glm::ivec3& value) const;
    void set(const char* name, const glm::ivec4& value) const;
    void set(const char* name, const glm::mat3& value) const;
    void set(const char* name, const glm::mat4& value) const;
    void set(const char* name, std::span<const glm::vec4> values) const; ///< an array, from its first element

    [[nodiscard]] GLuint id() const { return name_.id(); }

private:
    explicit Program(ObjectName name) : name_(std::move(name)) {}
    [[nodiscard]] GLint location(const char* name) const;

    ObjectName name_;
    mutable std::map<std::string, GLint, std::less<>> locations_;
};

/// Makes what shaders wrote (images, storage buffers) visible to fetches, images, storage, framebuffers and
/// copies.
void storageBarrier();

} // namespace voxsheet::gpu
