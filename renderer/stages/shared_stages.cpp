#include "stages/shared_stages.h"

#include "gpu/context.h"

namespace voxsheet {

SharedStages::SharedStages(gpu::Context& gpuContext)
    : context(gpuContext), programs(gpuContext), classification(gpuContext), emptySpace(gpuContext),
      interpolateRootsInShader(gpuContext.workarounds().coarseFilterWeights) {}

gpu::ShaderDefines SharedStages::definesFor(const DrawRequest& request) const {
    const auto& [tile, volumes, frame, target, rows] = request;
    auto defines =
        ClassificationStage::defines(*tile.transfer, volumes.volume, filterFloatsInShader, tile.categories);
    if (filterCoarsely) defines.emplace_back("COARSE_FILTER", "1");
    for (const auto& more : {ClipStage::defines(tile.clip, volumes.clipObject, filterFloatsInShader),
                             ShadingStage::defines(tile.shading, volumes.gradients)})
        defines.insert(defines.end(), more.begin(), more.end());
    defines.emplace_back("SOLIDS", volumes.solids != nullptr ? "1" : "0");
    defines.emplace_back("SKIP_EMPTY", skipEmptySpace ? "1" : "0");
    return defines;
}

void SharedStages::bindFor(const gpu::Program& program, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    classification.bind(program, tile.transfer, volumes.volume);
    setRayUniforms(program, frame, tile.sizePixels);
    ClipStage::bind(program, tile, placedGrid(volumes.volume.meta->grid, tile.periodic), volumes.clipObject);
    ShadingStage::bind(program, tile, volumes.volume, volumes.gradients);
    if (volumes.solids != nullptr) volumes.solids->bind(solidsUnit);
}

} // namespace voxsheet
