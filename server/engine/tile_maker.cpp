#include "engine/tile_maker.h"

#include "base/errors.h"
#include "engine/isosurface_resolver.h"
#include "engine/tile_identity.h"

namespace voxsheet::engine {

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
    if (style.technique == sheet::Technique::Isosurface)
        look.isosurface = resolveIsosurface(style.isosurface, look.transfer.function, *summary);
    return look;
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
            draw(tile, look(workbook, sheetIndex, cell, view, contents), quality);
        } catch (const InvalidInput& error) {
            if (!view.request.empty()) throw;
            tile.code = error.field() == "field" ? "#REF!" : "#TYPE!";
            tile.message = error.what();
        } catch (const Error& error) {
            tile.code = "#IMPORT!";
            tile.message = error.what();
        }
    }
    if (!tile.spec) {
        tile.identity =
            textIdentity(environment_ + "\n" + tile.code + "\n" + tile.message + "\n" +
                         std::to_string(quality.sizePixels.x) + "x" + std::to_string(quality.sizePixels.y));
    }
    return tile;
}

void TileMaker::draw(PreparedTile& tile, const CellLook& look, const TileQuality& quality) {
    tile.spec = resolveTile(look.resolved.style, *look.meta, look.shown, cache_.table(look.transfer.function),
                            quality.sizePixels, quality.level, quality.sampleDistanceFactor);
    tile.spec->isosurface = look.isosurface;
    tile.identity = tileIdentity(*tile.spec, environment_);
}

} // namespace voxsheet::engine
