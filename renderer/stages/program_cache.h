// Programs by shader path and defines, compiled when first asked for.
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"

#include <map>
#include <string>
#include <string_view>

namespace voxsheet {

class ProgramCache {
public:
    explicit ProgramCache(gpu::Context& context) : context_(context) {}

    /// Paths are relative to renderer/. Throw GpuError as gpu::Program; the reference holds while the cache
    /// lives.
    const gpu::Program& compute(std::string_view path, const gpu::ShaderDefines& defines);
    const gpu::Program& graphics(std::string_view vertexPath, std::string_view fragmentPath,
                                 const gpu::ShaderDefines& defines);

private:
    gpu::Context& context_;
    std::map<std::string, gpu::Program> programs_;
};

} // namespace voxsheet
