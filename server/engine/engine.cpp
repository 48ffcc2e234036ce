#include "engine/engine.h"

#include "engine/atom_probe.h"
#include "engine/child_importer.h"
#include "engine/colour_bar.h"
#include "engine/colour_map.h"
#include "engine/engine_implementation.h"
#include "engine/sample_reader.h"
#include "engine/sheet_image.h"
#include "import/client/import_options_json.h"
#include "sheet/dataset_names.h"
#include "volume/elements.h"

#include <algorithm>

namespace voxsheet::engine {

namespace {

namespace fs = std::filesystem;

/// A file name in the folder that is not taken yet.
fs::path freeFile(const fs::path& folder, const std::string& name) {
    fs::path file = folder / name;
    for (int number = 2; fs::exists(file); ++number)
        file = folder / (std::to_string(number) + "-" + name);
    return file;
}

const char* hitName(HitKind kind) {
    switch (kind) {
    case HitKind::Isosurface:
        return "isosurface";
    case HitKind::Face:
        return "face";
    case HitKind::Sample:
        return "sample";
    case HitKind::Middle:
        break;
    }
    return "middle";
}

} // namespace

Engine::Engine(EngineOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Engine::~Engine() = default;

std::vector<std::string> Engine::importDatasets(const std::vector<ImportRequest>& requests,
                                                const ImportLayout& layout) {
    for (const auto& request : requests) // before anything is named, placed or started
        (void)import::importOptionsFromJson(request.options);
    std::vector<ImportRequest> sorted = requests;
    std::stable_sort(sorted.begin(), sorted.end(), [](const ImportRequest& a, const ImportRequest& b) {
        return !a.files.empty() && !b.files.empty() &&
               sheet::naturalLess(a.files[0].string(), b.files[0].string());
    });
    return implementation_->import(sorted, layout);
}

std::string Engine::importUpload(const std::string& name, const fs::path& receivedFile,
                                 const std::string& fileName) {
    const fs::path file = freeFile(options().uploadDir, safeFileName(fileName));
    std::error_code error;
    fs::rename(receivedFile, file, error);
    if (error) {
        // Another file system: copy.
        fs::copy_file(receivedFile, file, error);
        if (error)
            throw IoError("upload '" + fileName + "'", "it cannot be kept: " + error.message(),
                          "check --upload-dir");
        fs::remove(receivedFile, error);
    }
    ImportRequest request;
    request.files = {file};
    request.name = name;
    try {
        return implementation_->import({request}, {}).front();
    } catch (...) {
        fs::remove(file, error);
        throw;
    }
}

std::vector<DatasetInfo> Engine::datasets() const {
    std::vector<DatasetInfo> infos;
    const sheet::Snapshot now = snapshot();
    for (const auto& [name, source] : now->datasets)
        infos.push_back(implementation_->infoOf(name, source));
    std::sort(infos.begin(), infos.end(),
              [](const DatasetInfo& a, const DatasetInfo& b) { return sheet::naturalLess(a.name, b.name); });
    return infos;
}

DatasetInfo Engine::dataset(const std::string& name) const {
    const sheet::Snapshot now = snapshot();
    return implementation_->infoOf(name, implementation_->sourceOf(*now, name));
}

void Engine::removeDataset(const std::string& name) {
    const sheet::Snapshot now = snapshot();
    const sheet::DatasetSource source = implementation_->sourceOf(*now, name);
    const JobState state = implementation_->datasets.state(source);
    implementation_->workbook.apply(sheet::RemoveDataset{name}, {});
    const bool shared = std::any_of(now->datasets.begin(), now->datasets.end(), [&](const auto& each) {
        return each.first != name && DatasetKeeper::idOf(each.second) == DatasetKeeper::idOf(source);
    });
    if (shared) return;
    implementation_->datasets.cancel(source);
    // The entry stays open: undo brings the dataset back.
    if (!state.meta) return;
    if (implementation_->thread) implementation_->thread->forget(state.meta->key);
    implementation_->hostCache->forget(state.meta->key);
}

void Engine::cancelImport(const std::string& name) {
    implementation_->datasets.cancel(implementation_->sourceOf(*snapshot(), name));
}

bool Engine::waitIdle(double seconds) const { return implementation_->datasets.waitIdle(seconds); }

nlohmann::json Engine::previewFile(const fs::path& file, const nlohmann::json& importOptions) const {
    return previewByChild(options(), implementation_->datasets.roots().resolve(file), importOptions);
}

sheet::Snapshot Engine::snapshot() const { return implementation_->workbook.snapshot(); }
std::uint64_t Engine::version() const { return snapshot()->version; }
const sheet::KeyTable& Engine::keys() const { return *implementation_->keys; }

EditReport Engine::apply(const sheet::Command& command, const std::string& gesture) {
    return implementation_->workbook.apply(command, gesture);
}

bool Engine::undo() { return implementation_->workbook.undo(); }
bool Engine::redo() { return implementation_->workbook.redo(); }
bool Engine::canUndo() const { return implementation_->workbook.canUndo(); }
bool Engine::canRedo() const { return implementation_->workbook.canRedo(); }
nlohmann::json Engine::workbookJson() const { return implementation_->workbook.document(); }

void Engine::setWorkbookJson(const nlohmann::json& document, const fs::path& folder, DocumentOrigin origin) {
    implementation_->workbook.replace(document, folder, origin);
}

void Engine::saveWorkbook(const fs::path& file) const { implementation_->workbook.save(file); }
std::optional<fs::path> Engine::saveRecovery() const { return implementation_->workbook.saveRecovery(); }

std::vector<CellStatus> Engine::cellStatuses(const sheet::Workbook& workbook,
                                             const std::string& sheetName) const {
    const std::size_t index = implementation_->indexOf(workbook, sheetName);
    const auto contents = implementation_->contents(workbook);
    std::vector<CellStatus> statuses;
    for (const auto& [address, cell] : workbook.sheets[index].cells) {
        if (cell.source.empty()) continue;
        const CellContent& content = contentAt(*contents, {index, address});
        statuses.push_back({address,
                            content.state,
                            content.code,
                            content.message,
                            implementation_->datasets.progress(content),
                            content.meta,
                            content.notes,
                            {}});
        if (content.state != CellState::Ready) continue;
        const auto linked = implementation_->tiles.frame(workbook, index, address, {}, contents);
        const auto& style = sheet::resolveStyle(keys(), workbook.sheets[index], address).style;
        statuses.back().frame =
            linked.value_or(ownFrame(drawnGrid(content.meta->grid, periodicWindow(style.periodic))));
    }
    return statuses;
}

PreparedTile Engine::prepareTile(const sheet::Workbook& workbook, const std::string& sheetName,
                                 const sheet::Address& cell, const View& view,
                                 const TileQuality& quality) const {
    const std::size_t index = implementation_->indexOf(workbook, sheetName);
    const auto contents = implementation_->contents(workbook);
    PreparedTile tile = implementation_->tiles.prepare(workbook, index, cell, view, quality, contents);
    const CellContent& content = contentAt(*contents, {index, cell});
    if (content.state == CellState::Pending) tile.progress = implementation_->datasets.progress(content);
    return tile;
}

PreparedTile Engine::atLevel(PreparedTile tile, int level) const {
    return implementation_->tiles.atLevel(std::move(tile), level);
}

PreparedTile Engine::atQuality(const PreparedTile& tile, const TileQuality& quality) const {
    return implementation_->tiles.atQuality(tile, quality);
}

std::future<FrameResult> Engine::render(FrameSpec frame, FramePriority priority,
                                        std::function<bool()> cancelled) const {
    return implementation_->render(std::move(frame), priority, std::move(cancelled));
}

void Engine::setShown(const std::string& viewer, std::vector<WantedVolume> volumes) {
    if (!implementation_->thread) return;
    const std::lock_guard lock(implementation_->shownMutex);
    if (auto all = implementation_->shown.replace(viewer, std::move(volumes)))
        implementation_->thread->setWanted(std::move(*all));
}

SheetImage Engine::renderSheet(const SheetImageRequest& request) const {
    const sheet::Snapshot now = snapshot();
    const SheetImageSources sources{
        keys(), implementation_->tiles, implementation_->typesetter,
        [this](const std::vector<TileSpec>& specs, PixelFormat format) {
            return render({.tiles = specs, .format = format}, FramePriority::Export).get();
        }};
    return composeSheet(request, *now, implementation_->contents(*now), sources);
}

std::vector<ProbeValue> Engine::probeWorld(const std::string& sheetName, const glm::dvec3& world) const {
    const sheet::Snapshot now = snapshot();
    const std::size_t index = implementation_->indexOf(*now, sheetName);
    const auto contents = implementation_->contents(*now);
    const View view;
    return implementation_->probes.atWorld(*now, index, view, *contents, world,
                                           implementation_->layersOf(*now, index, view, contents));
}

std::vector<ProbeValue> Engine::probePixel(const std::string& sheetName, const sheet::Address& cell,
                                           const View& view, glm::dvec2 pixel, glm::ivec2 sizePixels) const {
    const sheet::Snapshot now = snapshot();
    const std::size_t index = implementation_->indexOf(*now, sheetName);
    const auto contents = implementation_->contents(*now);
    TileQuality quality;
    quality.sizePixels = sizePixels;
    const PreparedTile tile = implementation_->tiles.prepare(*now, index, cell, view, quality, contents);
    if (!tile.spec) return {};
    const DatasetMeta& meta = *contentAt(*contents, {index, cell}).meta;
    const auto opacity =
        sheet::resolveStyle(keys(), now->sheets[index], cell, {view.all, view.cells, view.request})
            .style.probeOpacity;
    const auto hit = implementation_->probes.underPixel(*tile.spec, meta, pixel, opacity);
    const Ray ray = pixelRay(tile.spec->camera, pixel, sizePixels);
    auto atom = implementation_->probes.atomOnRay(*tile.spec, meta, ray);
    const bool flat = tile.spec->technique == Technique::Plane;
    // A volume's middle is a place to ask for, nothing that is in front of anything.
    if (atom && hit && !flat && hit->kind != HitKind::Middle && hit->depth < atom->depth) atom.reset();
    if (!hit && !atom) return {};
    glm::dvec3 world = hit ? hit->world : atom->centreWorld;
    if (atom && !flat) world = atom->centreWorld;
    auto values = implementation_->probes.atWorld(*now, index, view, *contents, world,
                                                  implementation_->layersOf(*now, index, view, contents));
    for (ProbeValue& value : values) {
        if (value.cell != cell) continue;
        if (atom) {
            value.hit = "atom";
            value.atom = elementOf(atom->atomicNumber).symbol;
            continue;
        }
        value.hit = hitName(hit->kind);
        value.isovalue = hit->isovalue;
    }
    return values;
}

nlohmann::json Engine::colourBar(const std::string& sheetName, const sheet::Address& cell,
                                 const View& view) const {
    const sheet::Snapshot now = snapshot();
    const std::size_t index = implementation_->indexOf(*now, sheetName);
    const auto contents = implementation_->contents(*now);
    if (contentAt(*contents, {index, cell}).state != CellState::Ready) {
        throw NotFound("colour bar of cell " + sheet::addressName(cell), "the cell shows no volume",
                       "wait for its import, or see the cell's error");
    }
    return describeColourBar(implementation_->tiles.look(*now, index, cell, view, contents));
}

std::optional<ValueExtremes> Engine::valueRange(const std::string& sheetName, const sheet::Address& cell,
                                                const View& view, RangeOver over,
                                                glm::ivec2 sizePixels) const {
    const sheet::Snapshot now = snapshot();
    const std::size_t index = implementation_->indexOf(*now, sheetName);
    const auto contents = implementation_->contents(*now);
    const CellContent& content = contentAt(*contents, {index, cell});
    TileQuality quality;
    quality.sizePixels = sizePixels;
    const PreparedTile tile = implementation_->tiles.prepare(*now, index, cell, view, quality, contents);
    if (content.state != CellState::Ready || !tile.spec) {
        throw NotFound("range of cell " + sheet::addressName(cell), "the cell shows no volume",
                       "wait for its import, or see the cell's error");
    }
    if (over == RangeOver::Visible) return implementation_->probes.visible(*tile.spec, *content.meta);
    const FieldMeta& field = content.meta->fields.at(static_cast<std::size_t>(tile.spec->field));
    return extremesOf(field, over == RangeOver::Data ? std::optional(tile.spec->step) : std::nullopt);
}

nlohmann::json Engine::colourMaps() const { return describeColourMaps(ColourMapTable::embedded()); }

const std::vector<sheet::StylePreset>& Engine::stylePresets() const { return implementation_->presets; }

const RenderDevice* Engine::device() const {
    return implementation_->thread ? &implementation_->thread->device() : nullptr;
}

const std::vector<PathChoice>& Engine::paths() const {
    static const std::vector<PathChoice> none;
    return implementation_->thread ? implementation_->thread->paths() : none;
}

std::vector<WantedVolume> Engine::volumesOf(const TileSpec& tile, WantedPriority priority) const {
    return engine::volumesOf(tile, pathsOf(paths()), priority);
}

ResidencyState Engine::residency() const {
    return implementation_->thread ? implementation_->thread->residency() : ResidencyState{};
}

HostCacheState Engine::hostCache() const { return implementation_->hostCache->state(); }

const EngineOptions& Engine::options() const { return implementation_->options; }

std::uint64_t Engine::addListener(ChangeListener listener) {
    const std::lock_guard lock(implementation_->listenerMutex);
    implementation_->listeners[++implementation_->lastListener] = std::move(listener);
    return implementation_->lastListener;
}

void Engine::removeListener(std::uint64_t id) {
    const std::lock_guard lock(implementation_->listenerMutex);
    implementation_->listeners.erase(id);
}

} // namespace voxsheet::engine
