// Another volume whose values colour what a technique draws (colour_volume.glsl).
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"
#include "residency/residency_manager.h"
#include "stages/classification.h"
#include "stages/isosurface_spec.h"
#include "volume/grid.h"

namespace voxsheet {

class ColourVolumeStage {
public:
    static constexpr GLuint volumeUnit = 5;
    static constexpr GLuint tableUnit = 6;

    /// \param colours       the resident colouring volume, or null
    /// \param filterFloats  the shader interpolates 32-bit floats itself
    [[nodiscard]] static gpu::ShaderDefines defines(const std::optional<ColourVolume>& spec,
                                                    const ResidentVolume* colours, bool filterFloats);
    static void bind(const gpu::Program& program, const std::optional<ColourVolume>& spec, const Grid& grid,
                     const ResidentVolume* colours, ClassificationStage& classification);
};

} // namespace voxsheet
