#include "engine/probe_service.h"

#include "base/errors.h"
#include "engine/sample_reader.h"

#include <algorithm>

namespace voxsheet::engine {

std::vector<ProbeValue> ProbeService::atWorld(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                              const View& view, const CellContents& contents,
                                              const glm::dvec3& world) const {
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
            const auto style =
                sheet::resolveStyle(keys_, sheet, address, {view.all, view.cells, view.request}).style;
            const FieldAndStep shown = chooseField(style.field, style.timeStep, *content.meta);
            probe.unit = content.meta->fields[static_cast<std::size_t>(shown.field)].unit;
            if (const auto sample = samplePoint(*volumes_, *content.meta, shown.field, shown.step, world)) {
                probe.value = sample->value;
                probe.interpolated = sample->interpolated;
                probe.index = sample->nearest;
                if (!sample->value) probe.note = "no value here";
            } else {
                probe.note = "outside";
            }
        } catch (const Error& error) {
            probe.note = error.what();
        }
        values.push_back(std::move(probe));
    }
    return values;
}

std::optional<glm::dvec3> ProbeService::underPixel(const TileSpec& tile, const DatasetMeta& meta,
                                                   glm::dvec2 pixel) {
    return pointUnderPixel(tile, meta.grid, *levelFor(meta, tile.field, tile.step), pixel);
}

std::shared_ptr<const LevelSamples> ProbeService::levelFor(const DatasetMeta& meta, int field, int step) {
    VolumeKey key{meta.key, field, step, 0};
    while (key.level + 1 < meta.levels() && sampleCount(levelDims(meta.grid.dims, key.level)) > kLevelSamples)
        ++key.level;
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
