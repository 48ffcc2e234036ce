#include "techniques/render_paths.h"

#include <algorithm>

namespace voxsheet {
namespace {

constexpr std::array kPaths{RenderPath::Shader, RenderPath::Simd};

bool hasKernel(Technique technique) {
    TileSpec plain;
    plain.technique = technique;
    return VOXSHEET_SIMD != 0 && marchesRays(plain);
}

template <typename Values, typename NameOf>
auto named(const Values& values, std::string_view name, NameOf nameOf) {
    const auto found =
        std::find_if(values.begin(), values.end(), [&](auto value) { return name == nameOf(value); });
    return found != values.end() ? std::optional(*found) : std::nullopt;
}

} // namespace

const char* pathName(RenderPath path) { return path == RenderPath::Simd ? "simd" : "shader"; }

std::optional<RenderPath> pathFromName(std::string_view name) { return named(kPaths, name, pathName); }

std::optional<Technique> techniqueFromName(std::string_view name) {
    return named(kTechniques, name, techniqueName);
}

std::vector<RenderPath> candidatePaths(Technique technique) {
    if (hasKernel(technique)) return {RenderPath::Shader, RenderPath::Simd};
    return {RenderPath::Shader};
}

RenderPaths pathsByRule(const gpu::Workarounds& workarounds) {
    RenderPaths paths;
    for (const Technique technique : kTechniques)
        if (workarounds.simdRays && hasKernel(technique)) paths.set(technique, RenderPath::Simd);
    return paths;
}

} // namespace voxsheet
