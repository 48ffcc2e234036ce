#include "techniques/isosurface/isosurface.h"

#include "base/errors.h"
#include "stages/banded_dispatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet {
namespace {

constexpr float kNever = std::numeric_limits<float>::max();

std::vector<Isosurface> sortedByTexel(const IsosurfaceSpec& spec, const ResidentVolume& volume) {
    auto surfaces = spec.surfaces;
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const Isosurface& a, const Isosurface& b) { return a.value < b.value; });
    if (volume.valueScale < 0.0) std::reverse(surfaces.begin(), surfaces.end());
    return surfaces;
}

double texelOf(double value, const ResidentVolume& volume) {
    return (value - volume.valueOffset) / volume.valueScale;
}

/// (s, t): a texel is inside when s * texel >= t. `above`: at or above the value, else at or below.
glm::vec2 insideTest(double value, bool above, const ResidentVolume& volume) {
    const double sign = (above ? 1.0 : -1.0) * (volume.valueScale < 0.0 ? -1.0 : 1.0);
    return {sign, sign * texelOf(value, volume)};
}

void setCaps(const gpu::Program& program, const IsosurfaceSpec& spec, const ResidentVolume& volume) {
    std::optional<double> smallestPositive;
    std::optional<double> largestNegative;
    std::optional<double> smallest;
    for (const auto& surface : spec.surfaces) {
        const double value = surface.value;
        if (value > 0.0) smallestPositive = std::min(value, smallestPositive.value_or(value));
        if (value < 0.0) largestNegative = std::max(value, largestNegative.value_or(value));
        smallest = std::min(value, smallest.value_or(value));
    }
    const glm::vec2 never(0.0F, kNever);
    const bool neither = !smallestPositive && !largestNegative && smallest;
    program.set("capTexels", smallestPositive ? insideTest(*smallestPositive, true, volume)
                             : neither        ? insideTest(*smallest, true, volume)
                                              : never);
    program.set("mirroredCapTexels", largestNegative ? insideTest(*largestNegative, false, volume) : never);
}

/// Half of 1/64 of the range, in texels: what the plain test takes for equal.
double plainTestTolerance(const ResidentVolume& volume) {
    const auto& field = volume.meta->fields.at(static_cast<std::size_t>(volume.field));
    const auto& statistics = field.steps.at(static_cast<std::size_t>(volume.step)).statistics;
    return (statistics.max - statistics.min) / std::abs(volume.valueScale) / 128.0;
}

gpu::ShaderDefines definesOf(const SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    auto defines = stages.definesFor(request);
    const auto colours =
        ColourVolumeStage::defines(tile.isosurface.colouredBy, volumes.colours, stages.filterFloatsInShader);
    defines.insert(defines.end(), colours.begin(), colours.end());
    defines.emplace_back("CHUNK_SAMPLES",
                         std::to_string(chunkSamples(tile.sampleDistanceVoxels, kShortReach)));
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
    const auto surfaces = sortedByTexel(tile.isosurface, volume);
    std::vector<double> values;
    std::vector<glm::vec4> texels;
    std::vector<glm::vec4> colours;
    for (const auto& surface : surfaces) {
        values.push_back(surface.value);
        texels.emplace_back(static_cast<float>(texelOf(surface.value, volume)), 0.0F, 0.0F, 0.0F);
        colours.push_back(surface.colour);
    }
    if (stages.skipEmptySpace) stages.emptySpace.bindCrossed(program, values, volume);
    ColourVolumeStage::bind(program, tile.isosurface.colouredBy, placedGrid(volume.meta->grid, tile.periodic),
                            volumes.colours, stages.classification);
    program.set("surfaceTexels", texels);
    program.set("surfaceColours", colours);
    program.set("tolerance", static_cast<float>(plainTestTolerance(volume)));
    setCaps(program, tile.isosurface, volume);
    program.set("voxelsPerTexture", glm::vec3(volume.dims));
    program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
    target.bindImage(0, GL_WRITE_ONLY);
    dispatchPicture(
        program, tile.sizePixels,
        glm::length(glm::dvec3(volume.dims * tile.periodic.replicate)) / tile.sampleDistanceVoxels, rows);
}

} // namespace voxsheet
