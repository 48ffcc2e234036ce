#include "techniques/mip/mip.h"

#include "stages/banded_dispatch.h"

#include <string>

namespace voxsheet {

void drawMip(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& volume = volumes.volume;
    auto defines = stages.definesFor(request);
    defines.emplace_back("CHUNK_SAMPLES",
                         std::to_string(chunkSamples(tile.sampleDistanceVoxels, kLongReach)));
    const auto& program = stages.programs.compute("techniques/mip/mip.glsl", defines);

    stages.bindFor(program, request);
    if (stages.skipEmptySpace) stages.emptySpace.bindLargest(program, volume);
    program.set("voxelsPerTexture", glm::vec3(volume.dims));
    program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
    program.set("texelSign", volume.valueScale < 0.0 ? -1.0F : 1.0F);
    const float opacity = largestOpacity(*tile.transfer);
    program.set("opacityScale", opacity > 0.0F ? 1.0F / opacity : 0.0F);
    target->bindImage(0, GL_WRITE_ONLY);
    dispatchPicture(
        program, tile.sizePixels,
        glm::length(glm::dvec3(volume.dims * tile.periodic.replicate)) / tile.sampleDistanceVoxels, rows);
}

} // namespace voxsheet
