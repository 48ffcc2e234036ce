// What every technique draws with.
#pragma once

#include "stages/classification.h"
#include "stages/clip_stage.h"
#include "stages/colour_volume.h"
#include "stages/empty_space.h"
#include "stages/layer_stage.h"
#include "stages/picture_rows.h"
#include "stages/program_cache.h"
#include "stages/ray_frame.h"
#include "stages/shading_stage.h"

#include <vector>

namespace voxsheet {

/// The resident textures of one picture; null: the picture has no use for it.
struct DrawVolumes {
    const ResidentVolume& volume;
    const ResidentVolume* gradients = nullptr;
    const ResidentVolume* clipObject = nullptr;
    const ResidentVolume* colours = nullptr;
    std::vector<const ResidentVolume*> layers{}; ///< as in TileSpec::layers
    const gpu::Texture* solids = nullptr;        ///< what hides all behind it (solids.glsl)
};

inline constexpr GLuint solidsUnit = 16;

/// One picture to draw: what TechniqueSet::draw was given, and its rays.
struct DrawRequest {
    const TileSpec& tile;
    const DrawVolumes& volumes;
    const RayFrame& frame;
    const gpu::Texture* target; ///< null: SimdRays draws into host memory
    PictureRows rows;           ///< nothing beyond them is written
};

struct SharedStages {
    explicit SharedStages(gpu::Context& gpuContext);

    /// Of classification, clipping, shading, solids and SKIP_EMPTY.
    [[nodiscard]] gpu::ShaderDefines definesFor(const DrawRequest& request) const;
    /// Binds and sets what classification, clipping, shading, solids and rays need.
    void bindFor(const gpu::Program& program, const DrawRequest& request);

    gpu::Context& context;
    ProgramCache programs;
    ClassificationStage classification;
    EmptySpaceStage emptySpace;
    bool skipEmptySpace = true;
    /// For drivers that do not filter 32-bit float textures.
    bool filterFloatsInShader = false;
    /// For drivers whose filter weighs samples coarsely.
    bool interpolateRootsInShader;
    /// Volumes are filtered as coarsely as GPUs do, for trials on devices that do not.
    bool filterCoarsely = false;
};

} // namespace voxsheet
