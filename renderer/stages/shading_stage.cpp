#include "stages/shading_stage.h"

#include "base/errors.h"
#include "stages/gradient_frame.h"
#include "volume/grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace voxsheet {
namespace {

constexpr int kSlicesPerDispatch = 64; ///< a dispatch of a large volume stays far below two seconds

void requireBetween(const char* key, double value, double low, double high) {
    if (!(value >= low && value <= high))
        throw InvalidInput(key, "it is outside [" + std::to_string(low) + ", " + std::to_string(high) + "]")
            .withField(key);
}

/// Largest possible difference of two texels.
double texelRange(const ResidentVolume& volume) {
    const auto& field = volume.meta->fields.at(static_cast<std::size_t>(volume.field));
    const auto& statistics = field.steps.at(static_cast<std::size_t>(volume.step)).statistics;
    const double range = (statistics.max - statistics.min) / std::abs(volume.valueScale);
    return range > 0.0 && std::isfinite(range) ? range : 1.0;
}

} // namespace

void validateShading(const ShadingSpec& shading) {
    requireBetween("shading.ambient", shading.ambient, 0.0, 1.0);
    requireBetween("shading.diffuse", shading.diffuse, 0.0, 1.0);
    requireBetween("shading.specular", shading.specular, 0.0, 1.0);
    requireBetween("shading.shininess", shading.shininess, 1.0, 1000.0);
    requireBetween("light.head", shading.headLight, 0.0, 1.0);
    requireBetween("light.intensity", shading.lightIntensity, 0.0, 1.0);
    if (shading.lightsView.size() > kMaxLights)
        throw InvalidInput("directional lights", "there are more than " + std::to_string(kMaxLights))
            .withField("light.direction");
    for (const auto& light : shading.lightsView)
        if (!(std::abs(glm::length(light) - 1.0) < 1e-6))
            throw InvalidInput("light direction", "it does not have unit length")
                .withField("light.direction");
}

gpu::ShaderDefines ShadingStage::defines(const ShadingSpec& shading, const ResidentVolume* gradients) {
    return {{"SHADING", shading.enabled ? "1" : "0"},
            {"LIGHTS", std::to_string(shading.enabled ? shading.lightsView.size() : 0)},
            {"GRADIENT_TEXTURE", gradients != nullptr ? "1" : "0"}};
}

void ShadingStage::bindLight(const gpu::Program& program, const ShadingSpec& shading) {
    program.set("material", glm::vec4(shading.ambient, shading.diffuse, shading.specular, shading.shininess));
    program.set("headLight", static_cast<float>(shading.headLight));
    std::vector<glm::vec4> lights;
    for (const auto& light : shading.lightsView)
        lights.emplace_back(glm::dvec4(light, shading.lightIntensity));
    if (!lights.empty()) program.set("lights", lights);
}

void ShadingStage::bind(const gpu::Program& program, const TileSpec& tile, const ResidentVolume& volume,
                        const ResidentVolume* gradients) {
    const auto& shading = tile.shading;
    if (!shading.enabled) return;
    bindLight(program, shading);
    if (gradients != nullptr) gradients->texture->bind(gradientUnit);
    std::vector<glm::vec4> normals;
    for (const auto& plane : tile.clip.planes)
        normals.emplace_back(glm::dvec4(glm::dmat3(tile.camera.viewFromWorld) * plane.normal, 0.0));
    program.set("cutNormals", normals);
    const auto& grid = volume.meta->grid;
    program.set("viewFromGradient",
                viewFromGradient(viewFromVoxels(tile.camera.viewFromWorld, grid, volume.dims)));
    program.set("voxelSize", 1.0F / glm::vec3(volume.dims));
    program.set("gradientPeriodic", glm::vec3(grid.periodic));
}

void ShadingStage::buildGradients(ProgramCache& programs, const ResidentVolume& volume, gpu::Texture& rgba16f,
                                  int zBegin, int zCount) {
    const auto& program = programs.compute("stages/gradient_texture.glsl", {});
    volume.texture->bind(0);
    rgba16f.bindImage(0, GL_WRITE_ONLY);
    program.set("periodic", glm::ivec3(volume.meta->grid.periodic));
    program.set("scale", static_cast<float>(1.0 / texelRange(volume)));
    const auto groups = [](int samples, int size) { return (samples + size - 1) / size; };
    const int end = zBegin + zCount;
    program.set("endSlice", end);
    for (int slice = zBegin; slice < end; slice += kSlicesPerDispatch) {
        const int slices = std::min(kSlicesPerDispatch, end - slice);
        program.set("firstSlice", slice);
        program.dispatch({groups(volume.dims.x, 8), groups(volume.dims.y, 8), groups(slices, 4)});
        if (slice + slices < end) glFlush();
    }
    gpu::storageBarrier();
}

} // namespace voxsheet
