#include "engine/tile_maker.h"

#include "base/errors.h"
#include "engine/isosurface_resolver.h"
#include "engine/tile_identity.h"

#include <algorithm>

namespace voxsheet::engine {

namespace {

/// What a cell shows for a style that cannot be drawn.
const char* codeOf(const InvalidInput& error) {
    for (const char* naming : {"field", "clip.shape", "isosurface.colorBy"}) {
        if (error.field() == naming) return "#REF!";
    }
    return "#TYPE!";
}

} // namespace

CellLook TileMaker::look(const sheet::Workbook& workbook, std::size_t sheetIndex, const sheet::Address& cell,
                         const View& view, const std::shared_ptr<const CellContents>& contents) {
    const sheet::Sheet& sheet = workbook.sheets.at(sheetIndex);
    CellLook look;
    look.resolved = sheet::resolveStyle(keys_, sheet, cell, {view.all, view.cells, view.request});
    sheet::requireConsistent(look.resolved.style);
    look.meta = contentAt(*contents, {sheetIndex, cell}).meta;
    if (!look.meta) throw InternalError("cell " + sheet::addressName(cell), "it has nothing to show");
    const sheet::TypedStyle& style = look.resolved.style;
    look.shown = chooseField(style.field, style.timeStep, *look.meta);
    look.sharedRange = style.range.mode == sheet::RangeMode::Shared;
    const double path = boxPathUnitLengths(look.meta->grid);
    const auto summary = look.sharedRange ? sharedSummary(workbook, sheetIndex, cell, look, contents)
                                          : cache_.summary(*look.meta, look.shown.field, look.shown.step);
    look.transfer = resolveTransfer(look.resolved, maps_, *summary, path);
    if (style.technique == sheet::Technique::Isosurface) {
        sheet::IsosurfaceStyle surfaces = style.isosurface;
        // Where distances are 0 is the surface that they were taken from.
        if (surfaces.values.empty() && holdsSignedDistances(*look.meta)) surfaces.values = {0.0};
        const auto* map = look.transfer.map;
        const bool paleAtZero =
            look.transfer.diverging && map != nullptr && map->kind == ColourMapKind::Diverging;
        look.isosurface = resolveIsosurface(surfaces, look.transfer.function, *summary, paleAtZero);
    }
    findNamedVolumes(look, {workbook, sheetIndex, cell, view, *contents, style.timeStep});
    return look;
}

void TileMaker::findNamedVolumes(CellLook& look, const NamingCell& from) {
    const sheet::TypedStyle& style = look.resolved.style;
    if (style.clip.shape.empty()) {
        named_.releaseClipObject(from);
    } else {
        auto object = named_.clipObject(style.clip.shape, from);
        look.clipObject = std::move(object.volume);
        look.missing = std::move(object.missing);
    }
    const std::string& colourBy = style.isosurface.colourBy;
    if (style.technique != sheet::Technique::Isosurface || colourBy.empty()) return;
    auto colours =
        named_.find(sheet::parseVolumeName(colourBy, "isosurface.colorBy"), from, "isosurface.colorBy");
    if (!colours.volume) {
        look.missing = std::move(colours.missing);
        return;
    }
    ColouringLook by{colours.volume->meta, {colours.volume->field, colours.volume->step}, {}};
    // What was typed in, or shared, is a range of the cell's own quantity.
    sheet::ResolvedStyle own = look.resolved;
    own.style.range = {};
    own.style.range.scale = style.range.scale;
    by.transfer = resolveTransfer(own, maps_, *cache_.summary(*by.meta, by.shown.field, by.shown.step),
                                  boxPathUnitLengths(by.meta->grid));
    look.colouredBy = std::move(by);
}

std::shared_ptr<const ValueSummary>
TileMaker::sharedSummary(const sheet::Workbook& workbook, std::size_t sheetIndex,
                         const sheet::Address& asking, const CellLook& own,
                         const std::shared_ptr<const CellContents>& contents) {
    const sheet::Sheet& sheet = workbook.sheets[sheetIndex];
    const bool shares =
        sheet::resolveStyle(keys_, sheet, asking).style.range.mode == sheet::RangeMode::Shared;
    if (shares) {
        const std::lock_guard lock(mutex_);
        if (shared_.version == workbook.version && shared_.sheetIndex == sheetIndex &&
            shared_.contents == contents) {
            return shared_.summary;
        }
    }
    std::vector<ValueSummary> summaries = sharingSummaries(workbook, sheetIndex, *contents);
    // Only the page's view or the request made it share: it joins the others without moving their ranges.
    if (!shares) summaries.push_back(*cache_.summary(*own.meta, own.shown.field, own.shown.step));
    auto merged = std::make_shared<const ValueSummary>(mergeSummaries(summaries));
    if (shares) {
        const std::lock_guard lock(mutex_);
        shared_ = {workbook.version, sheetIndex, contents, merged};
    }
    return merged;
}

std::vector<ValueSummary> TileMaker::sharingSummaries(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                      const CellContents& contents) {
    const sheet::Sheet& sheet = workbook.sheets[sheetIndex];
    std::vector<ValueSummary> summaries;
    for (const auto& [address, cell] : sheet.cells) {
        const CellContent& content = contentAt(contents, {sheetIndex, address});
        if (content.state != CellState::Ready) continue;
        const sheet::ResolvedStyle other = sheet::resolveStyle(keys_, sheet, address);
        if (other.style.range.mode != sheet::RangeMode::Shared) continue;
        try {
            const FieldAndStep shown = chooseField(other.style.field, other.style.timeStep, *content.meta);
            summaries.push_back(*cache_.summary(*content.meta, shown.field, shown.step));
        } catch (const Error&) {
            continue; // That cell shows its own error; the others still share.
        }
    }
    return summaries;
}

PreparedTile TileMaker::prepare(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                const sheet::Address& cell, const View& view, const TileQuality& quality,
                                const std::shared_ptr<const CellContents>& contents) {
    PreparedTile tile;
    tile.cell = cell;
    const CellContent& content = contentAt(*contents, {sheetIndex, cell});
    tile.code = content.code;
    tile.message = content.message;
    if (content.state == CellState::Pending) tile.progress = 0.0;
    if (content.state == CellState::Ready) {
        try {
            CellLook shown = look(workbook, sheetIndex, cell, view, contents);
            if (!quality.live && !view.request.contains("level")) shown.resolved.style.level.reset();
            draw(tile, shown, quality);
        } catch (const InvalidInput& error) {
            if (!view.request.empty()) throw;
            tile.code = codeOf(error);
            tile.message = error.what();
        } catch (const Error& error) {
            tile.code = "#IMPORT!";
            tile.message = error.what();
        }
    }
    if (!tile.spec) {
        tile.identity =
            textIdentity(environment_.text + "\n" + tile.code + "\n" + tile.message + "\n" +
                         std::to_string(quality.sizePixels.x) + "x" + std::to_string(quality.sizePixels.y));
    }
    return tile;
}

void TileMaker::draw(PreparedTile& tile, const CellLook& look, const TileQuality& quality) {
    if (look.missing) {
        tile.code = look.missing->code;
        tile.message = look.missing->message;
        if (tile.code.empty()) tile.progress = look.missing->progress;
        return;
    }
    const sheet::TypedStyle& style = look.resolved.style;
    TileSpec spec = resolveTile(style, *look.meta, look.shown, cache_.table(look.transfer.function),
                                quality.sizePixels, quality.level, quality.sampleDistanceFactor);
    if (look.clipObject) spec.clip.object = resolveClipObject(style.clip, *look.clipObject, look.meta->grid);
    spec.isosurface = look.isosurface;
    if (const auto& by = look.colouredBy) {
        spec.isosurface.colouredBy =
            ColourVolume{by->meta->key, by->shown.field, by->shown.step,
                         std::min(spec.level, by->meta->levels() - 1), cache_.table(by->transfer.function)};
        tile.colourVolumeLevels = by->meta->levels();
    }
    tile.needs = levelNeeds(spec, *look.meta, style, environment_.exactR8Filtering);
    tile.spec = std::move(spec);
    tile.identity = tileIdentity(*tile.spec, environment_.text);
}

PreparedTile TileMaker::atLevel(PreparedTile tile, int level) const {
    TileSpec& spec = tile.spec.value();
    const int wanted = std::clamp(level, 0, static_cast<int>(tile.needs.textureBytes.size()) - 1);
    if (wanted == spec.level) return tile;
    spec.level = wanted;
    if (auto& by = spec.isosurface.colouredBy) by->level = std::min(wanted, tile.colourVolumeLevels - 1);
    tile.identity = tileIdentity(spec, environment_.text);
    return tile;
}

} // namespace voxsheet::engine
