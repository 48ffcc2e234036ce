#include "techniques/raycast/raycast.h"

#include "stages/banded_dispatch.h"

#include <string>

namespace voxsheet {

void drawRaycast(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volume, frame, target] = request;
    auto defines = ClassificationStage::defines(*tile.transfer, volume);
    defines.emplace_back("CHUNK_SAMPLES", std::to_string(chunkSamples(tile.sampleDistanceVoxels)));
    defines.emplace_back("SKIP_EMPTY", stages.skipEmptySpace ? "1" : "0");
    const auto& program = stages.programs.compute("techniques/raycast/raycast.glsl", defines);

    stages.classification.bind(program, tile.transfer, volume);
    if (stages.skipEmptySpace) stages.emptySpace.bindOccupied(program, tile.transfer, volume);
    setRayUniforms(program, frame, tile.sizePixels);
    program.set("voxelsPerTexture", glm::vec3(volume.dims));
    program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
    program.set("unitsPerRadius", static_cast<float>(frame.radiusWorld / tile.unitLengthWorld));
    target.bindImage(0, GL_WRITE_ONLY);
    dispatchPicture(program, tile.sizePixels,
                    glm::length(glm::dvec3(volume.dims)) / tile.sampleDistanceVoxels);
}

} // namespace voxsheet
