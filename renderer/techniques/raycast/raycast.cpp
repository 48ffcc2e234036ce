#include "techniques/raycast/raycast.h"

#include "stages/banded_dispatch.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace voxsheet {

std::optional<StrideSettings> strideSettings(const TileSpec& tile, const ResidentVolume& volume) {
    if (!adaptsSampling(tile)) return std::nullopt;
    const auto& grid = volume.meta->grid;
    const double coarser = std::cbrt(static_cast<double>(sampleCount(grid.dims)) /
                                     static_cast<double>(sampleCount(volume.dims)));
    return StrideSettings{tile.sampleDistanceVoxels,
                          meanVoxelEdgeWorld(grid) * coarser / tile.unitLengthWorld, tile.shading.enabled,
                          MinMaxGrid::brickSamplesFor(volume.dims)};
}

void drawRaycast(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& volume = volumes.volume;
    auto defines = stages.definesFor(request);
    const auto layerDefines = LayerStage::defines(tile, volumes.layers, stages.filterFloatsInShader);
    defines.insert(defines.end(), layerDefines.begin(), layerDefines.end());
    const auto strides = stages.skipEmptySpace ? strideSettings(tile, volume) : std::nullopt;
    // Near a clip object's surface even samples are dear, and short chunks keep close to it.
    const int reach = shortReach(volume.dims);
    const int longest = chunkSamples(tile.sampleDistanceVoxels, reach);
    const int samples = volumes.clipObject != nullptr && !strides ? std::min(4, longest) : longest;
    defines.emplace_back("CHUNK_SAMPLES", std::to_string(samples));
    defines.emplace_back("PAIRS_SHARE_LIGHT", pairsShareLight(tile) ? "1" : "0");
    defines.emplace_back("ADAPTIVE", strides ? "1" : "0");
    defines.emplace_back("PRE_INTEGRATED", preIntegrates(tile) ? "1" : "0");
    const auto& program = stages.programs.compute("techniques/raycast/raycast.glsl", defines);

    stages.bindFor(program, request);
    LayerStage::bind(program, tile, volume, volumes.layers, stages.classification);
    if (preIntegrates(tile)) stages.classification.bindIntegrals(tile.transfer);
    if (stages.skipEmptySpace) {
        LayerStage::bindOccupied(program, tile, volume, volumes.layers, samples * tile.sampleDistanceVoxels,
                                 stages.emptySpace);
        stages.emptySpace.bindOccupied(program, tile.transfer, volume, reach, strides);
    }
    program.set("voxelsPerTexture", glm::vec3(volume.dims));
    program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
    program.set("unitsPerRadius", static_cast<float>(frame.radiusWorld / tile.unitLengthWorld));
    target->bindImage(0, GL_WRITE_ONLY);
    dispatchPicture(
        program, tile.sizePixels,
        glm::length(glm::dvec3(volume.dims * tile.periodic.replicate)) / tile.sampleDistanceVoxels, rows);
}

} // namespace voxsheet
