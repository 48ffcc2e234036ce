// Light as the shaders read it (shading.glsl), and gradient textures.
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"
#include "residency/residency_manager.h"
#include "stages/program_cache.h"
#include "stages/tile_spec.h"

#include <glm/glm.hpp>

namespace voxsheet {

/// Throws InvalidInput (with field) if a number is out of the ranges stated in ShadingSpec or a light has no
/// unit length.
void validateShading(const ShadingSpec& shading);

class ShadingStage {
public:
    static constexpr GLuint gradientUnit = 4;

    /// \param gradients  resident gradients, or null: six taps
    [[nodiscard]] static gpu::ShaderDefines defines(const ShadingSpec& shading,
                                                    const ResidentVolume* gradients);
    static void bind(const gpu::Program& program, const TileSpec& tile, const ResidentVolume& volume,
                     const ResidentVolume* gradients);
    /// Only what light.glsl needs.
    static void bindLight(const gpu::Program& program, const ShadingSpec& shading);

    /// Fills slices [zBegin, zBegin + zCount) of `rgba16f` with central differences of the volume's texels
    /// per voxel (one-sided at ends that do not wrap), divided by the largest that its texels allow, so that
    /// 16-bit floats hold them.
    static void buildGradients(ProgramCache& programs, const ResidentVolume& volume, gpu::Texture& rgba16f,
                               int zBegin, int zCount);
};

} // namespace voxsheet
