#include "engine/tile_maker.h"

#include "base/errors.h"
#include "engine/crystal_resolver.h"
#include "engine/isosurface_resolver.h"
#include "engine/tile_identity.h"
#include "sheet/utf8.h"

#include <algorithm>

namespace voxsheet::engine {

namespace {

void addNote(std::string& notes, const std::string& note) {
    notes += (notes.empty() || note.empty() ? "" : ". ") + note;
}

/// What a cell shows for a style that cannot be drawn.
const char* codeOf(const InvalidInput& error) {
    for (const char* naming : {"field", "clip.shape", "isosurface.colorBy", "layers", "overlay.dataset"}) {
        if (error.field() == naming) return "#REF!";
    }
    return "#TYPE!";
}

SharedQuantity quantityOf(const DatasetMeta& meta, const FieldAndStep& shown) {
    const FieldMeta& field = meta.fields.at(static_cast<std::size_t>(shown.field));
    return {field.quantity, field.unit};
}

bool isCell(const sheet::VolumeName& name, const NamingCell& cell) {
    const auto* address = std::get_if<sheet::SheetAddress>(&name);
    if (address == nullptr || address->cell != cell.cell) return false;
    return address->sheet.empty() || sheet::lowerAscii(address->sheet) ==
                                         sheet::lowerAscii(cell.workbook.sheets.at(cell.sheetIndex).name);
}

std::string volumeNameText(const sheet::VolumeName& name) {
    const auto* address = std::get_if<sheet::SheetAddress>(&name);
    return address != nullptr ? sheet::addressName(*address) : std::get<std::string>(name);
}

} // namespace

CellLook TileMaker::look(const sheet::Workbook& workbook, std::size_t sheetIndex, const sheet::Address& cell,
                         const View& view, const std::shared_ptr<const CellContents>& contents) {
    CellLook look = ownLook(workbook, sheetIndex, cell, view, contents);
    const NamingCell from{workbook, sheetIndex, cell, view, *contents, look.resolved.style.timeStep};
    findClipObject(look, from);
    findColours(look, from);
    findLayers(look, from, contents);
    findOverlay(look, from, contents);
    return look;
}

CellLook TileMaker::ownLook(const sheet::Workbook& workbook, std::size_t sheetIndex,
                            const sheet::Address& cell, const View& view,
                            const std::shared_ptr<const CellContents>& contents) {
    const sheet::Sheet& sheet = workbook.sheets.at(sheetIndex);
    CellLook look;
    look.resolved = sheet::resolveStyle(keys_, sheet, cell, {view.all, view.cells, view.request});
    sheet::requireConsistent(look.resolved.style);
    look.meta = contentAt(*contents, {sheetIndex, cell}).meta;
    if (!look.meta) throw InternalError("cell " + sheet::addressName(cell), "it has nothing to show");
    look.frame = frameOf(look.resolved.style, workbook, sheetIndex, cell, view, contents);
    const std::string periodsNote = dropLinkedPeriods(look.resolved, look.meta->grid);
    const sheet::TypedStyle& style = look.resolved.style;
    look.shown = chooseField(style.field, style.timeStep, *look.meta);
    look.sharedRange = style.range.mode == sheet::RangeMode::Shared;
    const double path = boxPathUnitLengths(look.meta->grid);
    const auto summary = look.sharedRange ? sharedSummary(workbook, sheetIndex, cell, look, contents)
                                          : cache_.summary(*look.meta, look.shown.field, look.shown.step);
    look.transfer = cache_.transfer(look.resolved, maps_, summary, path);
    if (style.labels.show) addLabels(look);
    if (style.technique == sheet::Technique::Isosurface) {
        sheet::IsosurfaceStyle surfaces = style.isosurface;
        // Where distances are 0 is the surface that they were taken from.
        if (surfaces.values.empty() && holdsSignedDistances(*look.meta)) surfaces.values = {0.0};
        const auto* map = look.transfer.map;
        const bool paleAtZero =
            look.transfer.diverging && map != nullptr && map->kind == ColourMapKind::Diverging;
        look.isosurface = resolveIsosurface(surfaces, look.transfer.function, *summary, paleAtZero);
        look.note = emptySurfacesNote(look.isosurface.surfaces,
                                      *cache_.summary(*look.meta, look.shown.field, look.shown.step));
    }
    addNote(look.note, missingCrystalNote(style.crystal, *look.meta));
    addNote(look.note, periodsNote);
    return look;
}

void TileMaker::addLabels(CellLook& look) const {
    const sheet::TypedStyle& style = look.resolved.style;
    if (style.technique == sheet::Technique::Mip || style.technique == sheet::Technique::Isosurface)
        throw InvalidInput("labels.show", "largest values and isosurfaces of label numbers mean nothing",
                           "set technique to plane, raycast, slices or surface, or labels.show to off")
            .withField("labels.show");
    const FieldMeta& field = look.meta->fields.at(static_cast<std::size_t>(look.shown.field));
    look.labels = makeLabelTable(style.labels, look.meta->labels, field, look.shown.step,
                                 style.labels.opacity, "labels.show");
}

void TileMaker::findClipObject(CellLook& look, const NamingCell& from) {
    const sheet::TypedStyle& style = look.resolved.style;
    const bool clips = style.technique != sheet::Technique::Plane && !style.clip.shape.empty();
    if (!clips) {
        named_.releaseClipObject(from);
    } else {
        auto object = named_.clipObject(style.clip.shape, from);
        look.clipObject = std::move(object.volume);
        look.missing = std::move(object.missing);
    }
}

void TileMaker::findColours(CellLook& look, const NamingCell& from) {
    const sheet::TypedStyle& style = look.resolved.style;
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
    by.transfer = cache_.transfer(own, maps_, cache_.summary(*by.meta, by.shown.field, by.shown.step),
                                  boxPathUnitLengths(by.meta->grid));
    look.colouredBy = std::move(by);
}

void TileMaker::findLayers(CellLook& look, const NamingCell& from,
                           const std::shared_ptr<const CellContents>& contents) {
    const sheet::LayersStyle& layers = look.resolved.style.layers;
    if (layers.volumes.empty()) return;
    const auto names = sheet::parseLayers(layers.volumes);
    for (std::size_t i = 0; i < names.size(); ++i) {
        // A style that is linked over the sheet reaches the cells that it names, too: they are there already.
        if (isCell(names[i], from)) continue;
        if (look.resolved.style.technique != sheet::Technique::Raycast) {
            throw InvalidInput("layers", "only ray casting blends several volumes in one picture",
                               "set technique to raycast, or layers to none")
                .withField("technique");
        }
        auto layer = layerLook(look, names[i], "layers", from, contents);
        if (!layer) return;
        layer->weight = layers.weights.at(std::min(i + 1, layers.weights.size() - 1));
        look.layers.push_back(std::move(*layer));
    }
}

std::optional<LayerLook> TileMaker::layerLook(CellLook& look, const sheet::VolumeName& name,
                                              const std::string& key, const NamingCell& from,
                                              const std::shared_ptr<const CellContents>& contents) {
    auto volume = named_.find(name, from, key);
    if (!volume.volume) {
        look.missing = std::move(volume.missing);
        return std::nullopt;
    }
    LayerLook layer;
    layer.name = volumeNameText(name);
    layer.meta = volume.volume->meta;
    layer.shown = {volume.volume->field, volume.volume->step};
    sheet::TypedStyle style;
    if (const auto* cell = std::get_if<sheet::SheetAddress>(&name)) {
        const std::size_t index =
            cell->sheet.empty() ? from.sheetIndex : sheet::sheetIndex(from.workbook, cell->sheet);
        CellLook other = ownLook(from.workbook, index, cell->cell, from.view, contents);
        layer.transfer = std::move(other.transfer);
        layer.labels = std::move(other.labels);
        style = std::move(other.resolved.style);
    } else {
        const sheet::ResolvedStyle initial = sheet::defaultStyle(keys_);
        layer.transfer =
            cache_.transfer(initial, maps_, cache_.summary(*layer.meta, layer.shown.field, layer.shown.step),
                            boxPathUnitLengths(layer.meta->grid));
        style = initial.style;
    }
    layer.unitLengthWorld = style.transfer.unitLengthWorld.value_or(meanVoxelEdgeWorld(layer.meta->grid));
    layer.floatTexels =
        style.textureFormat == sheet::TextureFormat::Half ? FloatTexels::Half : FloatTexels::Full;
    return layer;
}

void TileMaker::findOverlay(CellLook& look, const NamingCell& from,
                            const std::shared_ptr<const CellContents>& contents) {
    const sheet::OverlayStyle& overlay = look.resolved.style.overlay;
    if (overlay.volume.empty() || look.resolved.style.technique != sheet::Technique::Plane) return;
    const auto name = sheet::parseVolumeName(overlay.volume, "overlay.dataset");
    if (isCell(name, from)) return;
    auto layer = layerLook(look, name, "overlay.dataset", from, contents);
    if (!layer) return;
    const FieldMeta& field = layer->meta->fields.at(static_cast<std::size_t>(layer->shown.field));
    layer->weight = overlay.opacity;
    layer->threshold = overlay.threshold;
    if (overlay.map == "labels") {
        layer->labels = makeLabelTable(look.resolved.style.labels, layer->meta->labels, field,
                                       layer->shown.step, 1.0, "overlay.map");
    } else if (!layer->labels) {
        sheet::ResolvedStyle own = sheet::defaultStyle(keys_);
        own.style.transfer.map = overlay.map;
        if (overlay.min || overlay.max)
            own.style.range = {sheet::RangeMode::Fixed, overlay.min, overlay.max, ValueScale::Linear};
        layer->transfer =
            cache_.transfer(own, maps_, cache_.summary(*layer->meta, layer->shown.field, layer->shown.step),
                            boxPathUnitLengths(layer->meta->grid));
        layer->transfer.function.opacities = {{0.0, 1.0}};
    }
    look.layers = {std::move(*layer)};
}

std::shared_ptr<const ValueSummary>
TileMaker::sharedSummary(const sheet::Workbook& workbook, std::size_t sheetIndex,
                         const sheet::Address& asking, const CellLook& own,
                         const std::shared_ptr<const CellContents>& contents) {
    const sheet::Sheet& sheet = workbook.sheets[sheetIndex];
    const bool shares =
        sheet::resolveStyle(keys_, sheet, asking).style.range.mode == sheet::RangeMode::Shared;
    const SharedQuantity quantity = quantityOf(*own.meta, own.shown);
    if (shares) {
        const std::lock_guard lock(mutex_);
        if (shared_.version == workbook.version && shared_.sheetIndex == sheetIndex &&
            shared_.contents == contents) {
            const auto found = shared_.summaries.find(quantity);
            if (found != shared_.summaries.end()) return found->second;
        } else {
            shared_ = {workbook.version, sheetIndex, contents, {}};
        }
    }
    std::vector<ValueSummary> summaries = sharingSummaries(workbook, sheetIndex, *contents, quantity);
    // Only the page's view or the request made it share: it joins the others without moving their ranges.
    if (!shares) summaries.push_back(*cache_.summary(*own.meta, own.shown.field, own.shown.step));
    auto merged = std::make_shared<const ValueSummary>(mergeSummaries(summaries));
    if (shares) {
        const std::lock_guard lock(mutex_);
        if (shared_.version == workbook.version && shared_.sheetIndex == sheetIndex &&
            shared_.contents == contents) {
            shared_.summaries[quantity] = merged;
        }
    }
    return merged;
}

std::optional<CameraFrame> TileMaker::frame(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                            const sheet::Address& cell, const View& view,
                                            const std::shared_ptr<const CellContents>& contents) {
    const sheet::Sheet& sheet = workbook.sheets.at(sheetIndex);
    const auto resolved = sheet::resolveStyle(keys_, sheet, cell, {view.all, view.cells, view.request});
    return frameOf(resolved.style, workbook, sheetIndex, cell, view, contents);
}

std::optional<CameraFrame> TileMaker::frameOf(const sheet::TypedStyle& style, const sheet::Workbook& workbook,
                                              std::size_t sheetIndex, const sheet::Address& cell,
                                              const View& view,
                                              const std::shared_ptr<const CellContents>& contents) {
    const sheet::Sheet& sheet = workbook.sheets.at(sheetIndex);
    const sheet::FrameMode mode = style.camera.frame;
    if (mode == sheet::FrameMode::Fit) return std::nullopt;
    const Grid own =
        drawnGrid(contentAt(*contents, {sheetIndex, cell}).meta->grid, periodicWindow(style.periodic));
    const char* key = "camera.frame";
    const bool overridden = view.all.contains(key) || view.request.contains(key);
    if (!overridden && sheet::resolveStyle(keys_, sheet, cell).style.camera.frame == mode) {
        const std::lock_guard lock(mutex_);
        if (frames_.version != workbook.version || frames_.sheetIndex != sheetIndex ||
            frames_.contents != contents)
            frames_ = {workbook.version, sheetIndex, contents, {}};
        auto found = frames_.bounds.find(mode);
        if (found == frames_.bounds.end()) {
            auto bounds = boundsOf(framedGrids(workbook, sheetIndex, mode, {}, *contents));
            found = frames_.bounds.emplace(mode, bounds).first;
        }
        return linkedFrame(mode, own, found->second);
    }
    auto grids = framedGrids(workbook, sheetIndex, mode, view, *contents);
    grids.push_back(own);
    return linkedFrame(mode, own, boundsOf(grids));
}

std::vector<Grid> TileMaker::framedGrids(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                         sheet::FrameMode mode, const View& view,
                                         const CellContents& contents) const {
    const sheet::Sheet& sheet = workbook.sheets[sheetIndex];
    std::vector<Grid> grids;
    for (const auto& [address, cell] : sheet.cells) {
        const CellContent& content = contentAt(contents, {sheetIndex, address});
        if (content.state != CellState::Ready) continue;
        const sheet::TypedStyle style =
            sheet::resolveStyle(keys_, sheet, address, {view.all, view.cells, view.request}).style;
        if (style.camera.frame == mode)
            grids.push_back(drawnGrid(content.meta->grid, periodicWindow(style.periodic)));
    }
    return grids;
}

std::vector<ValueSummary> TileMaker::sharingSummaries(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                      const CellContents& contents,
                                                      const SharedQuantity& quantity) {
    const sheet::Sheet& sheet = workbook.sheets[sheetIndex];
    std::vector<ValueSummary> summaries;
    for (const auto& [address, cell] : sheet.cells) {
        const CellContent& content = contentAt(contents, {sheetIndex, address});
        if (content.state != CellState::Ready) continue;
        const sheet::ResolvedStyle other = sheet::resolveStyle(keys_, sheet, address);
        if (other.style.range.mode != sheet::RangeMode::Shared) continue;
        try {
            const FieldAndStep shown = chooseField(other.style.field, other.style.timeStep, *content.meta);
            if (quantityOf(*content.meta, shown) != quantity) continue;
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
            auto shown = std::make_shared<CellLook>(look(workbook, sheetIndex, cell, view, contents));
            if (!quality.live && !view.request.contains("level")) shown->resolved.style.level.reset();
            draw(tile, *shown, quality);
            tile.look = std::move(shown);
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

PreparedTile TileMaker::atQuality(const PreparedTile& tile, const TileQuality& quality) {
    PreparedTile other;
    other.cell = tile.cell;
    other.look = tile.look;
    draw(other, *tile.look, quality);
    return other;
}

std::shared_ptr<const TransferTable> TileMaker::tableOf(const std::optional<LabelTable>& labels,
                                                        const ResolvedTransfer& transfer) {
    return labels ? labels->table : cache_.table(transfer.function);
}

void TileMaker::draw(PreparedTile& tile, const CellLook& look, const TileQuality& quality) {
    if (look.missing) {
        tile.code = look.missing->code;
        tile.message = look.missing->message;
        if (tile.code.empty()) tile.progress = look.missing->progress;
        return;
    }
    const sheet::TypedStyle& style = look.resolved.style;
    TileSpec spec = resolveTile(style, *look.meta, look.shown, tableOf(look.labels, look.transfer),
                                quality.sizePixels, quality.level, quality.sampleDistanceFactor, look.frame);
    if (!quality.crosshair || style.annotations != sheet::Annotations::All) spec.crosshairWorld.reset();
    if (look.labels) {
        spec.categories = true;
        spec.shading.enabled = false;
        spec.level = 0; // Coarser levels hold means, and the mean of two labels is a third one.
    }
    if (look.clipObject)
        spec.clip.object =
            resolveClipObject(style.clip, *look.clipObject, drawnGrid(look.meta->grid, spec.periodic));
    spec.isosurface = look.isosurface;
    if (const auto& by = look.colouredBy) {
        spec.isosurface.colouredBy =
            ColourVolume{by->meta->key, by->shown.field, by->shown.step,
                         std::min(spec.level, by->meta->levels() - 1), cache_.table(by->transfer.function)};
        tile.colourVolumeLevels = by->meta->levels();
    }
    if (!look.layers.empty()) spec.layers.ownWeight = style.layers.weights.front();
    for (const LayerLook& layer : look.layers) {
        const int levels = layer.labels ? 1 : layer.meta->levels();
        VolumeLayer drawn{layer.meta->key,
                          layer.shown.field,
                          layer.shown.step,
                          std::min(spec.level, levels - 1),
                          tableOf(layer.labels, layer.transfer),
                          layer.unitLengthWorld,
                          layer.weight,
                          layer.floatTexels};
        drawn.categories = layer.labels.has_value();
        if (layer.threshold) drawn.threshold = *layer.threshold;
        spec.layers.volumes.push_back(std::move(drawn));
        tile.layerLevels.push_back(levels);
    }
    tile.needs = levelNeeds(spec, *look.meta, style, environment_.forms);
    if (look.labels) tile.needs.textureBytes.resize(1);
    tile.needs.further = furtherVolumes(look, environment_.forms.paths.onHost(spec));
    tile.note = look.note;
    tile.spec = std::move(spec);
    tile.identity = identityOf(*tile.spec);
}

std::string TileMaker::identityOf(const TileSpec& spec) const {
    return tileIdentity(spec, environment_.forms.paths.of(spec), environment_.text);
}

std::vector<FurtherVolume> TileMaker::furtherVolumes(const CellLook& look, bool onHost) const {
    std::vector<FurtherVolume> volumes;
    if (look.clipObject && look.clipObject->meta)
        volumes.push_back(clipObjectVolume(*look.clipObject->meta, onHost, environment_.forms.workarounds));
    if (const auto& by = look.colouredBy)
        volumes.push_back(furtherVolume(*by->meta, by->shown.field, by->shown.step,
                                        {FloatTexels::Full, onHost}, environment_.forms.workarounds));
    for (const LayerLook& layer : look.layers) {
        volumes.push_back(furtherVolume(*layer.meta, layer.shown.field, layer.shown.step,
                                        {layer.floatTexels, onHost}, environment_.forms.workarounds));
        if (layer.labels) volumes.back().textureBytes.resize(1);
    }
    return volumes;
}

PreparedTile TileMaker::atLevel(PreparedTile tile, int level) const {
    TileSpec& spec = tile.spec.value();
    const int wanted = std::clamp(level, 0, static_cast<int>(tile.needs.textureBytes.size()) - 1);
    if (wanted == spec.level) return tile;
    spec.level = wanted;
    if (auto& by = spec.isosurface.colouredBy) by->level = std::min(wanted, tile.colourVolumeLevels - 1);
    for (std::size_t i = 0; i < spec.layers.volumes.size(); ++i)
        spec.layers.volumes[i].level = std::min(wanted, tile.layerLevels.at(i) - 1);
    tile.identity = identityOf(spec);
    return tile;
}

} // namespace voxsheet::engine
