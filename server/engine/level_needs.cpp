#include "engine/level_needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::engine {

namespace {

constexpr std::uint64_t kGradientTexelBytes = 8; // RGBA16F

double nearestDepthWorld(const Grid& grid, const CameraSpec& camera) {
    const IndexBox box = boxIndex(grid);
    double nearest = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 index((corner & 1) != 0 ? box.high.x : box.low.x,
                               (corner & 2) != 0 ? box.high.y : box.low.y,
                               (corner & 4) != 0 ? box.high.z : box.low.z);
        const glm::dvec4 view = camera.viewFromWorld * (grid.worldFromIndex * glm::dvec4(index, 1.0));
        nearest = std::min(nearest, -view.z);
    }
    return nearest;
}

bool hasGradientTexture(const TileSpec& tile) {
    return tile.shading.enabled && tile.shading.gradient == GradientSource::Texture &&
           tile.technique != Technique::Mip && tile.technique != Technique::Surface &&
           tile.technique != Technique::Plane;
}

std::string volumeName(const std::string& dataset, int field, int step, FloatTexels floatTexels) {
    return dataset + "/" + std::to_string(field) + "/" + std::to_string(step) +
           (floatTexels == FloatTexels::Half ? "h" : "");
}

std::vector<std::uint64_t> bytesPerLevel(const DatasetMeta& meta, int field, FloatTexels floatTexels,
                                         bool exactR8Filtering, std::uint64_t gradientTexelBytes) {
    const ScalarType type = meta.fields.at(static_cast<std::size_t>(field)).storedType;
    std::vector<std::uint64_t> bytes;
    for (int level = 0; level < meta.levels(); ++level) {
        const TextureEncoding encoding =
            chooseTextureEncoding(levelType(type, level), 0.0, 1.0, exactR8Filtering, floatTexels);
        const auto texels = static_cast<std::uint64_t>(sampleCount(levelDims(meta.grid.dims, level)));
        bytes.push_back(texels * (texelFormatBytes(encoding.format) + gradientTexelBytes));
    }
    return bytes;
}

} // namespace

double texelEdgePixels(const Grid& grid, const CameraSpec& camera, glm::ivec2 sizePixels) {
    const glm::dvec3 spacing = spacingWorld(grid);
    const double edgeWorld = std::max({spacing.x, spacing.y, spacing.z});
    double heightWorld = camera.heightWorld;
    if (camera.projection == Projection::Perspective) {
        const double depth = nearestDepthWorld(grid, camera);
        if (depth <= 0.0) return std::numeric_limits<double>::infinity();
        heightWorld = 2.0 * depth * std::tan(glm::radians(camera.fovYDegrees) / 2.0);
    }
    return edgeWorld * sizePixels.y / heightWorld;
}

LevelNeeds levelNeeds(const TileSpec& tile, const DatasetMeta& meta, const sheet::TypedStyle& style,
                      bool exactR8Filtering) {
    LevelNeeds needs;
    const bool gradients = hasGradientTexture(tile);
    needs.volume = volumeName(tile.dataset, tile.field, tile.step, tile.floatTexels) + (gradients ? "g" : "");
    needs.work = std::to_string(static_cast<int>(tile.technique)) + (tile.shading.enabled ? "s" : "") +
                 (gradients ? "g" : "") + std::string(tile.layers.volumes.size(), 'l') + " " +
                 std::to_string(tile.sampleDistanceVoxels);
    needs.texelEdgePixels =
        texelEdgePixels(drawnGrid(meta.grid, tile.periodic), tile.camera, tile.sizePixels);
    needs.finest = static_cast<int>(style.quality);
    needs.pinned = style.level;
    needs.textureBytes = bytesPerLevel(meta, tile.field, tile.floatTexels, exactR8Filtering,
                                       gradients ? kGradientTexelBytes : 0);
    return needs;
}

FurtherVolume furtherVolume(const DatasetMeta& meta, int field, int step, FloatTexels floatTexels,
                            bool exactR8Filtering) {
    return {volumeName(meta.key, field, step, floatTexels),
            bytesPerLevel(meta, field, floatTexels, exactR8Filtering, 0)};
}

FurtherVolume clipObjectVolume(const DatasetMeta& meta, bool exactR8Filtering) {
    FurtherVolume object = furtherVolume(meta, 0, 0, FloatTexels::Full, exactR8Filtering);
    object.textureBytes.resize(1);
    return object;
}

} // namespace voxsheet::engine
