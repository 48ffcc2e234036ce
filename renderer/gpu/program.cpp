#include "gpu/program.h"

#include "base/errors.h"
#include "base/log.h"
#include "gpu/context.h"

#include <glm/gtc/type_ptr.hpp>

#include <utility>
#include <vector>

namespace voxsheet::gpu {

namespace {

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n'))
        log.pop_back();
    return log;
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n'))
        log.pop_back();
    return log;
}

/// A compiled shader, gone at the end of its scope: the program keeps what it needs.
class Stage {
public:
    Stage(GLenum type, const ShaderText& source) : id_(glCreateShader(type)) {
        const char* text = source.text.c_str();
        glShaderSource(id_, 1, &text, nullptr);
        glCompileShader(id_);
        GLint compiled = GL_FALSE;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        const std::string log = mapShaderLog(source, shaderLog(id_));
        if (compiled == GL_TRUE) {
            if (!log.empty()) logMessage(LogLevel::Debug, "shader " + source.name + ": " + log);
            return;
        }
        glDeleteShader(id_);
        throw GpuError("shader " + source.name, "it does not compile:\n" + log);
    }
    ~Stage() { glDeleteShader(id_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    [[nodiscard]] GLuint id() const { return id_; }

private:
    GLuint id_;
};

ObjectName link(Context& context, const std::string& name, const std::vector<GLuint>& stages) {
    const GLuint id = glCreateProgram();
    for (const GLuint stage : stages)
        glAttachShader(id, stage);
    glLinkProgram(id);
    for (const GLuint stage : stages)
        glDetachShader(id, stage);
    GLint linked = GL_FALSE;
    glGetProgramiv(id, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        const std::string log = programLog(id);
        glDeleteProgram(id);
        throw GpuError("shader program " + name, "it does not link:\n" + log);
    }
    ++context.mutableCounts().programs;
    return {context, id};
}

} // namespace

Program Program::compute(Context& context, const ShaderText& shader) {
    const Stage stage(GL_COMPUTE_SHADER, shader);
    return Program(link(context, shader.name, {stage.id()}));
}

Program Program::graphics(Context& context, const ShaderText& vertex, const ShaderText& fragment) {
    const Stage vertexStage(GL_VERTEX_SHADER, vertex);
    const Stage fragmentStage(GL_FRAGMENT_SHADER, fragment);
    return Program(
        link(context, vertex.name + " + " + fragment.name, {vertexStage.id(), fragmentStage.id()}));
}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(locations_, other.locations_);
    return *this;
}

Program::~Program() {
    if (!name_) return;
    glDeleteProgram(name_.id());
    --name_.context().mutableCounts().programs;
}

void Program::use() const { glUseProgram(name_.id()); }

void Program::dispatch(glm::ivec3 groups) const {
    use();
    glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                      static_cast<GLuint>(groups.z));
}

GLint Program::location(const char* name) const {
    const auto known = locations_.find(std::string_view(name));
    if (known != locations_.end()) return known->second;
    const GLint found = glGetUniformLocation(name_.id(), name);
    locations_.emplace(name, found);
    return found;
}

void Program::set(const char* name, int value) const { glProgramUniform1i(id(), location(name), value); }
void Program::set(const char* name, unsigned value) const {
    glProgramUniform1ui(id(), location(name), value);
}
void Program::set(const char* name, float value) const { glProgramUniform1f(id(), location(name), value); }
void Program::set(const char* name, const glm::vec2& value) const {
    glProgramUniform2fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec3& value) const {
    glProgramUniform3fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec4& value) const {
    glProgramUniform4fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::ivec2& value) const {
    glProgramUniform2iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::ivec3& value) const {
    glProgramUniform3iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::ivec4& value) const {
    glProgramUniform4iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat3& value) const {
    glProgramUniformMatrix3fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, std::span<const glm::vec4> values) const {
    if (values.empty()) return;
    glProgramUniform4fv(id(), location(name), static_cast<GLsizei>(values.size()),
                        glm::value_ptr(values.front()));
}

void storageBarrier() {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_PIXEL_BUFFER_BARRIER_BIT);
}

} // namespace voxsheet::gpu
