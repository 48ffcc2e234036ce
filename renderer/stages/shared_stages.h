// What every technique draws with.
#pragma once

#include "stages/classification.h"
#include "stages/empty_space.h"
#include "stages/program_cache.h"
#include "stages/ray_frame.h"

namespace voxsheet {

struct SharedStages {
    explicit SharedStages(gpu::Context& gpuContext)
        : context(gpuContext), programs(gpuContext), classification(gpuContext), emptySpace(gpuContext) {}

    gpu::Context& context;
    ProgramCache programs;
    ClassificationStage classification;
    EmptySpaceStage emptySpace;
    bool skipEmptySpace = true;
};

/// One picture to draw: what TechniqueSet::draw was given, and its rays.
struct DrawRequest {
    const TileSpec& tile;
    const ResidentVolume& volume;
    const RayFrame& frame;
    const gpu::Texture& target;
};

} // namespace voxsheet
