// Volumes blended with the drawn one, as the shaders read them (layers.glsl).
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"
#include "residency/residency_manager.h"
#include "stages/classification.h"
#include "stages/empty_space.h"
#include "stages/tile_spec.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace voxsheet {

/// Throws InvalidInput (field `layers` or `layers.weights`) if there are too many, a layer is out of the
/// ranges stated in VolumeLayer, or the technique cannot blend them.
void validateLayers(const TileSpec& tile);

/// Where a layer lies in the drawn volume, and how much it counts.
struct LayerPlacement {
    glm::dmat4 fromTexture;     ///< texture frame of the drawn volume to that of the layer
    glm::dvec3 boxLow, boxHigh; ///< of the layer, in its texture frame
    double density;             ///< extinction per unit of the drawn volume's opacity; its weight included
    glm::mat3 viewFromGradient; ///< of differences per voxel of its level
};
[[nodiscard]] LayerPlacement placementOf(const TileSpec& tile, std::size_t layer,
                                         const ResidentVolume& volume, const ResidentVolume& resident);

/// Samples of a layer, on any axis, that half a stretch in any direction covers at most.
/// \param stretchVoxels  length of the stretches that are looked up, in voxels of the drawn level
[[nodiscard]] int layerReachSamples(const ResidentVolume& volume, const ResidentVolume& layer,
                                    double stretchVoxels);

class LayerStage {
public:
    static constexpr GLuint volumeUnit = 7; ///< of the first; the others follow
    static constexpr GLuint tableUnit = 10; ///< likewise
    static constexpr GLuint cellsUnit = 13; ///< likewise

    /// \param layers        resident, in the tile's order
    /// \param filterFloats  the shader interpolates 32-bit floats itself
    [[nodiscard]] static gpu::ShaderDefines
    defines(const TileSpec& tile, std::span<const ResidentVolume* const> layers, bool filterFloats);
    static void bind(const gpu::Program& program, const TileSpec& tile, const ResidentVolume& volume,
                     std::span<const ResidentVolume* const> layers, ClassificationStage& classification);
    /// Where they can show something.
    /// \param stretchVoxels  length of the stretches that are looked up, in voxels of the drawn level
    static void bindOccupied(const gpu::Program& program, const TileSpec& tile, const ResidentVolume& volume,
                             std::span<const ResidentVolume* const> layers, double stretchVoxels,
                             EmptySpaceStage& emptySpace);
};

} // namespace voxsheet
