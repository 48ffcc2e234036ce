#include "stages/layer_stage.h"

#include "base/errors.h"
#include "stages/gradient_frame.h"
#include "volume/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace voxsheet {
namespace {

/// Texture coordinates are 32-bit floats: a point on a face of two equal boxes is inside both.
constexpr double kFaceSlack = 1e-6;

bool isWeight(double weight) { return weight >= 0.0 && weight <= 1.0; }

std::string member(std::size_t layer, const char* name) {
    return "layers[" + std::to_string(layer) + "]." + name;
}

GLuint unitOf(GLuint first, std::size_t layer) { return first + static_cast<GLuint>(layer); }

/// Both at the same point of the world; layers lie where they lie, whatever window of the own volume is
/// drawn.
glm::dmat4 layerFromTexture(const ResidentVolume& volume, const PeriodicWindow& window,
                            const ResidentVolume& layer) {
    const auto placed = placedGrid(volume.meta->grid, window);
    return glm::inverse(worldFromTexture(layer.meta->grid)) * worldFromTexture(placed);
}

void setLayer(const gpu::Program& program, std::size_t i, const TileSpec& tile, const ResidentVolume& volume,
              const ResidentVolume& resident) {
    const auto& layer = tile.layers.volumes[i];
    const auto& grid = resident.meta->grid;
    const auto set = [&](const char* name, const auto& value) {
        program.set(member(i, name).c_str(), value);
    };
    const auto mapping = classificationMapping(*layer.transfer, resident.valueScale, resident.valueOffset);
    const auto placement = placementOf(tile, i, volume, resident);
    set("fromTexture", glm::mat4(placement.fromTexture));
    set("boxLow", glm::vec3(placement.boxLow));
    set("boxHigh", glm::vec3(placement.boxHigh));
    set("voxels", glm::vec3(resident.dims));
    set("periodic", glm::vec3(grid.periodic));
    set("mappedFromTexel", glm::vec2(mapping.mappedFromTexel));
    set("entryFromMapped", glm::vec2(mapping.entryFromMapped));
    set("lastEntry", static_cast<float>(layer.transfer->entries.size() + 1));
    set("density", static_cast<float>(placement.density));
    if (tile.technique == Technique::Plane) {
        constexpr double all = -std::numeric_limits<float>::max();
        // What integers become in the shader is a little off: the threshold itself must still pass.
        const bool exact = resident.texture->internalFormat() == GL_R32F;
        const double rounding =
            exact ? 0.0 : 1e-6 * (std::abs(resident.valueScale) + std::abs(resident.valueOffset));
        set("valueFromTexel", glm::vec2(resident.valueScale, resident.valueOffset));
        set("threshold", static_cast<float>(std::max(layer.threshold - rounding, all)));
    }
    if (tile.shading.enabled) set("viewFromGradient", placement.viewFromGradient);
}

} // namespace

LayerPlacement placementOf(const TileSpec& tile, std::size_t i, const ResidentVolume& volume,
                           const ResidentVolume& resident) {
    const auto& layer = tile.layers.volumes[i];
    const auto& grid = resident.meta->grid;
    const auto box = boxIndex(grid);
    const bool flat = tile.technique == Technique::Plane;
    return {layerFromTexture(volume, tile.periodic, resident),
            (box.low + 0.5) / glm::dvec3(grid.dims) - kFaceSlack,
            (box.high + 0.5) / glm::dvec3(grid.dims) + kFaceSlack,
            layer.weight * (flat ? 1.0 : tile.unitLengthWorld / layer.unitLengthWorld),
            viewFromGradient(viewFromVoxels(tile.camera.viewFromWorld, grid, resident.dims))};
}

int layerReachSamples(const ResidentVolume& volume, const ResidentVolume& layer, double stretchVoxels) {
    const auto rows = glm::transpose(glm::dmat3(layerFromTexture(volume, {}, layer)));
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, glm::length(rows[axis] / glm::dvec3(volume.dims)) * layer.dims[axis]);
    const int all = std::max({layer.dims.x, layer.dims.y, layer.dims.z});
    return std::max(shortReach(layer.dims),
                    static_cast<int>(std::min(std::ceil(0.5 * stretchVoxels * largest), double(all))));
}

void validateLayers(const TileSpec& tile) {
    const auto& layers = tile.layers;
    if (layers.volumes.empty()) return;
    if (tile.technique != Technique::Raycast && tile.technique != Technique::Plane)
        throw InvalidInput("layers", "only ray casting and planes show several volumes",
                           "set technique to raycast or plane, or layers to none")
            .withField("layers");
    if (layers.volumes.size() > kMaxLayers)
        throw InvalidInput("layers", "there are more than " + std::to_string(kMaxLayers)).withField("layers");
    const auto& all = layers.volumes;
    if (!isWeight(layers.ownWeight) ||
        !std::all_of(all.begin(), all.end(), [](const auto& layer) { return isWeight(layer.weight); }))
        throw InvalidInput("layers.weights", "one is outside [0, 1]").withField("layers.weights");
    for (const auto& layer : all) {
        if (!layer.transfer || layer.transfer->entries.size() < 2)
            throw InvalidInput("transfer function of a layer", "there is none").withField("layers");
        if (std::isnan(layer.threshold))
            throw InvalidInput("threshold of a layer", "it is no number").withField("overlay.threshold");
        if (!(layer.unitLengthWorld > 0.0 && std::isfinite(layer.unitLengthWorld)))
            throw InvalidInput("unit length of a layer's opacity", "it is not above 0").withField("layers");
    }
}

gpu::ShaderDefines LayerStage::defines(const TileSpec& tile, std::span<const ResidentVolume* const> layers,
                                       bool filterFloats) {
    gpu::ShaderDefines defines{{"LAYERS", std::to_string(layers.size())}};
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const auto number = std::to_string(i);
        const bool filter = filterFloats && layers[i]->texture->internalFormat() == GL_R32F;
        const bool categories = tile.layers.volumes[i].categories;
        const auto scale = static_cast<int>(tile.layers.volumes[i].transfer->scale);
        defines.emplace_back("LAYER_SCALE_" + number, std::to_string(scale));
        defines.emplace_back("LAYER_FILTER_" + number, categories ? "2" : filter ? "1" : "0");
    }
    return defines;
}

void LayerStage::bind(const gpu::Program& program, const TileSpec& tile, const ResidentVolume& volume,
                      std::span<const ResidentVolume* const> layers, ClassificationStage& classification) {
    if (layers.empty()) return;
    program.set("ownDensity", static_cast<float>(tile.layers.ownWeight));
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layers[i]->texture->bind(unitOf(volumeUnit, i));
        classification.bindTable(tile.layers.volumes[i].transfer, unitOf(tableUnit, i));
        setLayer(program, i, tile, volume, *layers[i]);
    }
}

void LayerStage::bindOccupied(const gpu::Program& program, const TileSpec& tile, const ResidentVolume& volume,
                              std::span<const ResidentVolume* const> layers, double stretchVoxels,
                              EmptySpaceStage& emptySpace) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const auto& layer = *layers[i];
        emptySpace
            .occupied(tile.layers.volumes[i].transfer, layer, layerReachSamples(volume, layer, stretchVoxels))
            .bind(unitOf(cellsUnit, i));
        const auto layout = CellLayout::of(layer.dims);
        const auto samples = static_cast<float>(layout.cellSamples);
        program.set(member(i, "cellSamples").c_str(), samples);
        program.set(member(i, "cellsPerTexture").c_str(), glm::vec3(layer.dims) / samples);
        program.set(member(i, "lastCell").c_str(), layout.cells - 1);
    }
}

} // namespace voxsheet
