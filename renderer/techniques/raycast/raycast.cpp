#include "techniques/raycast/raycast.h"

#include "stages/banded_dispatch.h"

#include <algorithm>
#include <string>

namespace voxsheet {

void drawRaycast(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& volume = volumes.volume;
    auto defines = stages.definesFor(request);
    // Near a clip object's surface samples are dear, and short chunks keep close to it.
    const int samples = chunkSamples(tile.sampleDistanceVoxels, kShortReach);
    defines.emplace_back("CHUNK_SAMPLES",
                         std::to_string(volumes.clipObject != nullptr ? std::min(4, samples) : samples));
    const auto& program = stages.programs.compute("techniques/raycast/raycast.glsl", defines);

    stages.bindFor(program, request);
    if (stages.skipEmptySpace) stages.emptySpace.bindOccupied(program, tile.transfer, volume, kShortReach);
    program.set("voxelsPerTexture", glm::vec3(volume.dims));
    program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
    program.set("unitsPerRadius", static_cast<float>(frame.radiusWorld / tile.unitLengthWorld));
    target.bindImage(0, GL_WRITE_ONLY);
    dispatchPicture(program, tile.sizePixels,
                    glm::length(glm::dvec3(volume.dims)) / tile.sampleDistanceVoxels, rows);
}

} // namespace voxsheet
