#include "stages/program_cache.h"

#include "stages/shader_files.h"

namespace voxsheet {
namespace {

std::string keyOf(std::string_view path, const gpu::ShaderDefines& defines) {
    std::string key(path);
    for (const auto& [name, text] : defines)
        key += '\n' + name + '=' + text;
    return key;
}

} // namespace

const gpu::Program& ProgramCache::compute(std::string_view path, const gpu::ShaderDefines& defines) {
    const auto key = keyOf(path, defines);
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        auto program = gpu::Program::compute(context_, gpu::expandShader(embeddedShaders(), path, defines));
        found = programs_.emplace(key, std::move(program)).first;
    }
    return found->second;
}

const gpu::Program& ProgramCache::graphics(std::string_view vertexPath, std::string_view fragmentPath,
                                           const gpu::ShaderDefines& defines) {
    const auto key = std::string(vertexPath) + '+' + keyOf(fragmentPath, defines);
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        auto program =
            gpu::Program::graphics(context_, gpu::expandShader(embeddedShaders(), vertexPath, defines),
                                   gpu::expandShader(embeddedShaders(), fragmentPath, defines));
        found = programs_.emplace(key, std::move(program)).first;
    }
    return found->second;
}

} // namespace voxsheet
