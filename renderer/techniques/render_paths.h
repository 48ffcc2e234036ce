// By which code a technique draws, where it has more than one. Pure: what there is, and what the rule takes.
// What draws keeps a RenderPaths; frame/path_choice.h decides it.
#pragma once

#include "gpu/workarounds.h"
#include "stages/tile_spec.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace voxsheet {

enum class RenderPath {
    Shader, ///< OpenGL, on whatever device
    Simd,   ///< kernels on the processor (simd/kernels.h), which read volumes in host memory
};

inline constexpr std::array kTechniques{Technique::Slices,  Technique::Raycast,    Technique::Mip,
                                        Technique::Surface, Technique::Isosurface, Technique::Plane};

/// Raised when a path gets so much faster or slower that what was measured before is worth nothing.
inline constexpr int kPathFormat = 1;

/// "shader", "simd".
[[nodiscard]] const char* pathName(RenderPath path);
[[nodiscard]] std::optional<RenderPath> pathFromName(std::string_view name);
[[nodiscard]] std::optional<Technique> techniqueFromName(std::string_view name);

/// What this build can draw the technique by; never empty, shaders first.
[[nodiscard]] std::vector<RenderPath> candidatePaths(Technique technique);

/// One path for each technique; shaders until told otherwise.
class RenderPaths {
public:
    [[nodiscard]] RenderPath of(Technique technique) const {
        return paths_[static_cast<std::size_t>(technique)];
    }
    /// That of the tile's technique, but shaders for what only they can draw (marchesRays).
    [[nodiscard]] RenderPath of(const TileSpec& tile) const {
        return marchesRays(tile) ? of(tile.technique) : RenderPath::Shader;
    }
    /// True when the tile's volumes are held in host memory.
    [[nodiscard]] bool onHost(const TileSpec& tile) const { return of(tile) == RenderPath::Simd; }
    void set(Technique technique, RenderPath path) { paths_[static_cast<std::size_t>(technique)] = path; }

    bool operator==(const RenderPaths&) const = default;

private:
    std::array<RenderPath, kTechniques.size()> paths_{};
};

/// Kernels where the workaround "simd-rays" is in force, else shaders.
[[nodiscard]] RenderPaths pathsByRule(const gpu::Workarounds& workarounds);

} // namespace voxsheet
