#include "engine/level_needs.h"

#include "techniques/tile_acquisition.h"
#include "volume/host_texels.h"

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

/// As the residency manager keys it: one volume in two forms takes the bytes of both.
std::string volumeName(const std::string& dataset, int field, int step, TexelForm form) {
    return dataset + "/" + std::to_string(field) + "/" + std::to_string(step) +
           (form.floats == FloatTexels::Half ? "h" : "") + (form.onHost ? "r" : "");
}

std::vector<std::uint64_t> bytesPerLevel(const DatasetMeta& meta, int field, TexelForm form,
                                         const gpu::Workarounds& workarounds,
                                         std::uint64_t gradientTexelBytes) {
    const ScalarType type = meta.fields.at(static_cast<std::size_t>(field)).storedType;
    std::vector<std::uint64_t> bytes;
    for (int level = 0; level < meta.levels(); ++level) {
        const TextureEncoding encoding = chooseTextureEncoding(
            levelType(type, level), 0.0, 1.0, form.onHost || !workarounds.r8AsR16, form.floats);
        const auto dims = levelDims(meta.grid.dims, level);
        const auto texels = static_cast<std::uint64_t>(sampleCount(dims));
        const std::uint64_t samples = form.onHost ? HostTexels::bytesFor(encoding.format, dims)
                                                  : texels * texelFormatBytes(encoding.format);
        bytes.push_back(samples + texels * gradientTexelBytes);
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
                      const DeviceForms& device) {
    LevelNeeds needs;
    const bool gradients = wantsGradientTexture(tile, device.paths);
    const TexelForm form(tile.floatTexels, device.paths.onHost(tile));
    needs.volume = volumeName(tile.dataset, tile.field, tile.step, form) + (gradients ? "g" : "");
    needs.work = std::to_string(static_cast<int>(tile.technique)) + (tile.shading.enabled ? "s" : "") +
                 (gradients ? "g" : "") + std::string(tile.layers.volumes.size(), 'l') + " " +
                 std::to_string(tile.sampleDistanceVoxels);
    needs.texelEdgePixels =
        texelEdgePixels(drawnGrid(meta.grid, tile.periodic), tile.camera, tile.sizePixels);
    needs.finest = static_cast<int>(style.quality);
    needs.pinned = style.level;
    needs.textureBytes =
        bytesPerLevel(meta, tile.field, form, device.workarounds, gradients ? kGradientTexelBytes : 0);
    return needs;
}

FurtherVolume furtherVolume(const DatasetMeta& meta, int field, int step, TexelForm form,
                            const gpu::Workarounds& workarounds) {
    return {volumeName(meta.key, field, step, form), bytesPerLevel(meta, field, form, workarounds, 0)};
}

FurtherVolume clipObjectVolume(const DatasetMeta& meta, bool onHost, const gpu::Workarounds& workarounds) {
    FurtherVolume object = furtherVolume(meta, 0, 0, {FloatTexels::Full, onHost}, workarounds);
    object.textureBytes.resize(1);
    return object;
}

} // namespace voxsheet::engine
