#include "techniques/isosurface/isosurface.h"

#include "base/errors.h"
#include "stages/banded_dispatch.h"
#include "techniques/isosurface/surface_texels.h"

#include <cmath>
#include <string>
#include <vector>

namespace voxsheet {
namespace {

gpu::ShaderDefines definesOf(const SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    auto defines = stages.definesFor(request);
    const auto colours =
        ColourVolumeStage::defines(tile.isosurface.colouredBy, volumes.colours, stages.filterFloatsInShader);
    defines.insert(defines.end(), colours.begin(), colours.end());
    const int reach = shortReach(volumes.volume.dims);
    defines.emplace_back("CHUNK_SAMPLES", std::to_string(chunkSamples(tile.sampleDistanceVoxels, reach)));
    defines.emplace_back("EXACT_ROOTS", stages.interpolateRootsInShader ? "1" : "0");
    defines.emplace_back("CAPS", tile.isosurface.caps ? "1" : "0");
    defines.emplace_back("SURFACES", std::to_string(tile.isosurface.surfaces.size()));
    defines.emplace_back("ALPHA_TEST", tile.isosurface.method == IsosurfaceMethod::AlphaTest ? "1" : "0");
    return defines;
}

} // namespace

void validateIsosurface(const IsosurfaceSpec& isosurface) {
    if (isosurface.surfaces.size() > kMaxIsosurfaces)
        throw InvalidInput("isovalues", "there are more than " + std::to_string(kMaxIsosurfaces))
            .withField("isovalue");
    for (const auto& surface : isosurface.surfaces)
        if (!std::isfinite(surface.value))
            throw InvalidInput("isovalue", "it is not a finite number").withField("isovalue");
    if (isosurface.colouredBy && !isosurface.colouredBy->transfer)
        throw InternalError("colouring volume", "it has no transfer table");
}

void drawIsosurface(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& volume = volumes.volume;
    const auto& program =
        stages.programs.compute("techniques/isosurface/isosurface.glsl", definesOf(stages, request));
    stages.bindFor(program, request);
    const auto surfaces = surfaceTexels(tile.isosurface, volume);
    std::vector<glm::vec4> texels;
    for (const float texel : surfaces.texels)
        texels.emplace_back(texel, 0.0F, 0.0F, 0.0F);
    if (stages.skipEmptySpace) stages.emptySpace.bindCrossed(program, surfaces.values, volume);
    ColourVolumeStage::bind(program, tile.isosurface.colouredBy, placedGrid(volume.meta->grid, tile.periodic),
                            volumes.colours, stages.classification);
    program.set("surfaceTexels", texels);
    program.set("surfaceColours", surfaces.colours);
    program.set("tolerance", surfaces.plainTestTolerance);
    program.set("capTexels", surfaces.cap);
    program.set("mirroredCapTexels", surfaces.mirroredCap);
    program.set("voxelsPerTexture", glm::vec3(volume.dims));
    program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
    target->bindImage(0, GL_WRITE_ONLY);
    dispatchPicture(
        program, tile.sizePixels,
        glm::length(glm::dvec3(volume.dims * tile.periodic.replicate)) / tile.sampleDistanceVoxels, rows);
}

} // namespace voxsheet
