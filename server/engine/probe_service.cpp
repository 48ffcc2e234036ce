#include "engine/probe_service.h"

#include "base/errors.h"
#include "engine/cell_resolver.h"
#include "engine/sample_reader.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::engine {

std::vector<ProbeValue> ProbeService::atWorld(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                              const View& view, const CellContents& contents,
                                              const glm::dvec3& world, const LayersOf& layersOf) const {
    std::vector<ProbeValue> values;
    const sheet::Sheet& sheet = workbook.sheets.at(sheetIndex);
    for (const auto& [address, cell] : sheet.cells) {
        if (cell.source.empty()) continue;
        ProbeValue probe;
        probe.cell = address;
        probe.world = world;
        const CellContent& content = contentAt(contents, {sheetIndex, address});
        if (content.state != CellState::Ready) {
            probe.note = content.code.empty() ? content.message : content.code;
            values.push_back(std::move(probe));
            continue;
        }
        try {
            auto resolved = sheet::resolveStyle(keys_, sheet, address, {view.all, view.cells, view.request});
            (void)dropLinkedPeriods(resolved, content.meta->grid);
            const sheet::TypedStyle& style = resolved.style;
            const FieldAndStep shown = chooseField(style.field, style.timeStep, *content.meta);
            const PeriodicWindow window = resolvePeriodicWindow(style.periodic, content.meta->grid);
            probe.unit = content.meta->fields[static_cast<std::size_t>(shown.field)].unit;
            if (const auto sample =
                    samplePoint(*volumes_, *content.meta, shown.field, shown.step, window, world)) {
                probe.value = sample->value;
                probe.interpolated = sample->interpolated;
                probe.index = sample->nearest;
                if (!sample->value) probe.note = "no value here";
            } else {
                probe.note = "outside";
            }
            if (style.labels.show && probe.value) {
                const FieldMeta& field = content.meta->fields[static_cast<std::size_t>(shown.field)];
                probe.label =
                    makeLabelTable(style.labels, content.meta->labels, field, shown.step, 1.0, "labels.show")
                        .nameOf(*probe.value);
                probe.interpolated = probe.value;
            }
            const bool fused = style.technique == sheet::Technique::Raycast && !style.layers.volumes.empty();
            const bool overlaid = style.technique == sheet::Technique::Plane && !style.overlay.volume.empty();
            if (fused || overlaid)
                for (const LayerLook& layer : layersOf(address))
                    probe.layers.push_back(layerAt(layer, world));
        } catch (const Error& error) {
            probe.note = error.what();
        }
        values.push_back(std::move(probe));
    }
    return values;
}

LayerValue ProbeService::layerAt(const LayerLook& layer, const glm::dvec3& world) const {
    LayerValue value;
    value.name = layer.name;
    value.unit = layer.meta->fields[static_cast<std::size_t>(layer.shown.field)].unit;
    // Layers are drawn once, in the box of the cell's own volume.
    const auto sample =
        samplePoint(*volumes_, *layer.meta, layer.shown.field, layer.shown.step, PeriodicWindow{}, world);
    if (!sample) {
        value.note = "outside";
        return value;
    }
    value.value = sample->value;
    value.interpolated = sample->interpolated;
    if (!sample->value) value.note = "no value here";
    if (sample->value && layer.labels) {
        value.label = layer.labels->nameOf(*sample->value);
        value.interpolated = sample->value;
    }
    return value;
}

std::optional<PixelHit> ProbeService::underPixel(const TileSpec& tile, const DatasetMeta& meta,
                                                 glm::dvec2 pixel, std::optional<double> opacity) {
    const Level level = levelFor(meta, tile.field, tile.step);
    std::optional<ObjectSamples> object;
    if (tile.clip.object) object = objectOf(*tile.clip.object);
    auto hit = pixelHit(tile, {meta.grid, *level.samples, object ? &*object : nullptr}, pixel, opacity);
    if (hit && hit->kind == HitKind::Isosurface && level.key.level > 0)
        refine(*hit, tile, meta, pixelRay(tile.camera, pixel, tile.sizePixels), level.key.level);
    return hit;
}

std::optional<AtomHit> ProbeService::atomOnRay(const TileSpec& tile, const DatasetMeta& meta,
                                               const Ray& ray) {
    if (!meta.crystal || !tile.crystal.atoms) return std::nullopt;
    std::optional<ObjectSamples> object;
    if (tile.clip.object) object = objectOf(*tile.clip.object);
    return atomUnderRay(tile, crystalSites(*meta.crystal, meta.grid, tile.periodic, tile.crystal.bonds), ray,
                        object ? &*object : nullptr);
}

std::optional<ValueExtremes> ProbeService::visible(const TileSpec& tile, const DatasetMeta& meta) {
    std::optional<ObjectSamples> object;
    if (tile.clip.object) object = objectOf(*tile.clip.object);
    return visibleRange(tile, meta, *volumes_, object ? &*object : nullptr);
}

void ProbeService::refine(PixelHit& hit, const TileSpec& tile, const DatasetMeta& meta, const Ray& ray,
                          int level) const {
    const glm::dmat4 indexFromWorld = glm::inverse(placedGrid(meta.grid, tile.periodic).worldFromIndex);
    const double voxel = 1.0 / glm::length(glm::dvec3(indexFromWorld * glm::dvec4(ray.direction, 0.0)));
    const double reach = 2.0 * std::ldexp(voxel, level);
    const auto kept = keptSpan(ray, drawnGrid(meta.grid, tile.periodic), tile.clip.planes);
    if (!kept) return;
    const RaySpan nearby{std::max(kept->span.begin, hit.depth - reach),
                         std::min(kept->span.end, hit.depth + reach)};
    if (nearby.begin >= nearby.end) return;
    Level0Reader samples(*volumes_, meta, tile.field, tile.step);
    const auto depth = firstCrossing(
        [&](double s) {
            return samples.interpolated(glm::dvec3(indexFromWorld * glm::dvec4(ray.at(s), 1.0)));
        },
        *hit.isovalue, nearby, 0.5 * voxel);
    if (!depth) return;
    hit.depth = *depth;
    hit.world = ray.at(*depth);
}

ObjectSamples ProbeService::objectOf(const ClipObject& object) {
    const auto meta = volumes_->describe(object.dataset);
    return {meta->grid, samplesOf(*meta, {meta->key, 0, 0, 0})};
}

ProbeService::Level ProbeService::levelFor(const DatasetMeta& meta, int field, int step) {
    VolumeKey key{meta.key, field, step, 0};
    while (key.level + 1 < meta.levels() && sampleCount(levelDims(meta.grid.dims, key.level)) > kLevelSamples)
        ++key.level;
    return {key, samplesOf(meta, key)};
}

std::shared_ptr<const LevelSamples> ProbeService::samplesOf(const DatasetMeta& meta, const VolumeKey& key) {
    {
        const std::lock_guard lock(mutex_);
        const auto found =
            std::find_if(levels_.begin(), levels_.end(), [&](const auto& each) { return each.first == key; });
        if (found != levels_.end()) {
            levels_.splice(levels_.begin(), levels_, found);
            return found->second;
        }
    }
    auto level = std::make_shared<LevelSamples>();
    level->dims = levelDims(meta.grid.dims, key.level);
    level->periodic = meta.grid.periodic;
    const std::vector<double> values = readValues(*volumes_, meta, key, 0, level->dims.z);
    level->values.assign(values.begin(), values.end());
    const std::lock_guard lock(mutex_);
    levels_.emplace_front(key, level);
    if (levels_.size() > kLevels) levels_.pop_back();
    return level;
}

} // namespace voxsheet::engine
