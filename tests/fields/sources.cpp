#include "fields/sources.h"

#include "fields/index_slope.h"
#include "fields/sampled_field.h"

#include <memory>

namespace voxsheet::fields {
namespace {

ValueAt valuesOf(const std::shared_ptr<const Interpolant>& interpolant) {
    return [interpolant](const glm::dvec3& texture) { return interpolant->at(texture); };
}

/// Of categories: a point on the border of two voxels, or less than 1/1024 voxel below it, is in the higher
/// one.
ValueAt nearestValuesOf(const std::shared_ptr<const Interpolant>& interpolant) {
    const auto aboveBorder = 1.0 / 1024.0 / glm::dvec3(interpolant->dims());
    return [=](const glm::dvec3& texture) { return interpolant->nearest(texture + aboveBorder); };
}

ClipSource clipSourceOf(const VolumeProvider& volumes, const ClipObject& object) {
    const auto interpolant = std::make_shared<const Interpolant>(volumes, VolumeKey{object.dataset, 0, 0, 0});
    const auto meta = volumes.describe(object.dataset);
    const auto trilinear = valuesOf(interpolant);
    ClipSource source{meta->grid, interpolant->dims(), trilinear,
                      onTheFlySlope(trilinear, interpolant->dims(), meta->grid.periodic)};
    if (object.binary)
        source.distance = [interpolant](const glm::dvec3& texture) { return interpolant->nearest(texture); };
    return source;
}

/// As capsulesOf() takes it.
std::function<double(const glm::dvec3&)> objectMeasureOf(const TileSpec& tile,
                                                         const std::optional<ClipSource>& clip) {
    if (!clip) return {};
    const auto textureFromWorld =
        glm::inverse(worldFromTexture(clip->grid)) * tile.clip.object->objectFromWorld;
    const double sign = tile.clip.object->mode == ClipMode::Clip ? 1.0 : -1.0;
    return [textureFromWorld, sign, distance = clip->distance](const glm::dvec3& world) {
        return sign * distance(glm::dvec3(textureFromWorld * glm::dvec4(world, 1.0)));
    };
}

LayerSource layerSourceOf(const VolumeProvider& volumes, const VolumeLayer& layer) {
    const auto interpolant = std::make_shared<const Interpolant>(
        volumes, VolumeKey{layer.dataset, layer.field, layer.step, layer.level});
    const auto grid = volumes.describe(layer.dataset)->grid;
    const auto value = layer.categories ? nearestValuesOf(interpolant) : valuesOf(interpolant);
    return {grid, interpolant->dims(), value, onTheFlySlope(value, interpolant->dims(), grid.periodic)};
}

} // namespace

Sources sourcesOf(const VolumeProvider& volumes, const TileSpec& tile) {
    const auto meta = volumes.describe(tile.dataset);
    const auto interpolant = std::make_shared<const Interpolant>(
        volumes, VolumeKey{tile.dataset, tile.field, tile.step, tile.level});
    Sources sources;
    sources.grid = meta->grid;
    sources.levelDims = interpolant->dims();
    sources.value = tile.categories ? nearestValuesOf(interpolant) : valuesOf(interpolant);
    sources.nearest = [interpolant](const glm::dvec3& texture) { return interpolant->nearest(texture); };
    sources.indexSlope = tile.shading.gradient == GradientSource::Texture
                             ? textureSlope(sources.value, sources.levelDims, meta->grid.periodic)
                             : onTheFlySlope(sources.value, sources.levelDims, meta->grid.periodic);
    const auto& statistics = meta->fields.at(static_cast<std::size_t>(tile.field))
                                 .steps.at(static_cast<std::size_t>(tile.step))
                                 .statistics;
    sources.valueRange = statistics.max - statistics.min;
    if (tile.clip.object) sources.clip = clipSourceOf(volumes, *tile.clip.object);
    if (tile.isosurface.colouredBy) {
        const auto& by = *tile.isosurface.colouredBy;
        sources.colour = {volumes.describe(by.dataset)->grid,
                          valuesOf(std::make_shared<const Interpolant>(
                              volumes, VolumeKey{by.dataset, by.field, by.step, by.level}))};
    }
    sources.solids = capsulesOf(tile, *meta, objectMeasureOf(tile, sources.clip));
    for (const auto& layer : tile.layers.volumes)
        sources.layers.push_back(layerSourceOf(volumes, layer));
    return sources;
}

} // namespace voxsheet::fields
