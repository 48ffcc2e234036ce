#include "engine/engine.h"

#include "base/log.h"
#include "engine/child_importer.h"
#include "engine/colour_bar.h"
#include "engine/colour_map.h"
#include "engine/dataset_keeper.h"
#include "engine/probe_service.h"
#include "engine/sheet_image.h"
#include "engine/tile_identity.h"
#include "engine/tile_maker.h"
#include "engine/workbook_keeper.h"
#include "sheet/dataset_names.h"
#include "store/volume_store.h"

#include <algorithm>
#include <set>

#include <sched.h>
#include <unistd.h>

namespace voxsheet::engine {

namespace {

namespace fs = std::filesystem;

EngineOptions completed(EngineOptions options) {
    if (options.storeDir.empty()) options.storeDir = store::defaultStoreFolder();
    if (options.uploadDir.empty()) options.uploadDir = options.storeDir.parent_path() / "uploads";
    if (options.recoveryDir.empty()) options.recoveryDir = options.uploadDir;
    if (options.memoryBudgetBytes == 0) {
        const auto pages = static_cast<std::uint64_t>(std::max(1L, ::sysconf(_SC_PHYS_PAGES)));
        options.memoryBudgetBytes = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 4;
    }
    if (options.threads <= 0) {
        cpu_set_t cores;
        options.threads = ::sched_getaffinity(0, sizeof(cores), &cores) == 0 ? CPU_COUNT(&cores) : 1;
    }
    std::error_code error;
    for (const fs::path& folder : {options.storeDir, options.uploadDir}) {
        fs::create_directories(folder, error);
        if (error) {
            throw IoError("folder '" + folder.string() + "'", "it cannot be made: " + error.message(),
                          "choose another one with --store or --upload-dir");
        }
    }
    return options;
}

std::shared_ptr<const sheet::KeyTable> keyTable() {
    std::vector<std::string> maps = ColourMapTable::embedded().names();
    maps.insert(maps.begin(), "auto");
    return std::make_shared<const sheet::KeyTable>(sheet::makeKeyTable(std::move(maps)));
}

std::unique_ptr<RenderThread> renderThread(const EngineOptions& options,
                                           std::shared_ptr<const VolumeProvider> volumes) {
    if (!options.render) return nullptr;
    return std::make_unique<RenderThread>(std::move(volumes),
                                          RenderOptions{options.device, options.textureBudgetBytes});
}

std::string environmentOf(const RenderThread* thread) {
    if (thread == nullptr) return "no device " + buildIdentity();
    const RenderDevice& device = thread->device();
    std::string text =
        device.renderer + "\n" + device.vendor + "\n" + device.version + "\n" + buildIdentity();
    for (const std::string& workaround : device.workarounds)
        text += "\n" + workaround;
    return text;
}

/// A file name in the folder that is not taken yet.
fs::path freeFile(const fs::path& folder, const std::string& name) {
    fs::path file = folder / name;
    for (int number = 2; fs::exists(file); ++number)
        file = folder / (std::to_string(number) + "-" + name);
    return file;
}

} // namespace

class Engine::Implementation {
public:
    explicit Implementation(EngineOptions given)
        : options(completed(std::move(given))), keys(keyTable()),
          datasets(options, childImporter(options),
                   [this](bool settled, const std::string& importId) { datasetsChanged(settled, importId); }),
          thread(renderThread(options, datasets.volumes())),
          tiles(*keys, ColourMapTable::embedded(), datasets.volumes(), environmentOf(thread.get())),
          probes(*keys, datasets.volumes()),
          workbook(keys, options, [this](std::uint64_t version) { workbookChanged(version); }) {}

    /// Jobs call back into everything below them.
    ~Implementation() { datasets.stop(); }

    void workbookChanged(std::uint64_t version) {
        // Starts the imports and formulas that the new snapshot needs.
        static_cast<void>(datasets.contents(*keys, *workbook.snapshot()));
        notify(ChangeKind::Workbook, version);
    }

    void datasetsChanged(bool settled, const std::string& importId) {
        const sheet::Snapshot now = workbook.snapshot();
        if (settled) {
            static_cast<void>(datasets.contents(*keys, *now));
            if (!importId.empty()) noteSource(*now, importId);
        }
        notify(ChangeKind::Datasets, now->version);
    }

    /// Size and checksum of what was imported, for the workbook's file.
    void noteSource(const sheet::Workbook& now, const std::string& importId) {
        for (const auto& [name, source] : now.datasets) {
            if (!source.checksum.empty() || DatasetKeeper::idOf(source) != importId ||
                !datasets.state(source).meta)
                continue;
            try {
                sheet::DatasetSource known = source;
                known.bytes = 0;
                for (const std::string& file : source.files)
                    known.bytes += fs::file_size(file);
                known.checksum = checksumOf(source.files);
                workbook.amend(sheet::UpdateDataset{name, std::move(known)});
            } catch (const std::exception& error) {
                logWarning("no checksum of '" + name + "': " + error.what());
            }
        }
    }

    void notify(ChangeKind kind, std::uint64_t version) {
        std::vector<ChangeListener> called;
        {
            const std::lock_guard lock(listenerMutex);
            for (const auto& [id, listener] : listeners)
                called.push_back(listener);
        }
        for (const ChangeListener& listener : called)
            listener(kind, version);
    }

    DatasetInfo infoOf(const std::string& name, const sheet::DatasetSource& source) {
        const JobState state = datasets.state(source);
        DatasetInfo info;
        info.name = name;
        info.files.assign(source.files.begin(), source.files.end());
        info.state = state.state;
        info.progress = state.progress;
        info.failure = state.failure;
        info.meta = state.meta;
        info.job = state.job;
        return info;
    }

    const sheet::DatasetSource& sourceOf(const sheet::Workbook& now, const std::string& name) const {
        const auto found = now.datasets.find(name);
        if (found == now.datasets.end()) {
            throw NotFound("dataset '" + name + "'", "there is no such dataset in the workbook",
                           "list the datasets");
        }
        return found->second;
    }

    std::vector<std::string> import(const std::vector<ImportRequest>& requests, const ImportLayout& layout) {
        std::vector<sheet::NamedDataset> added;
        for (const ImportRequest& request : requests)
            added.push_back(namedDataset(request));
        std::vector<std::string> names;
        workbook.applyWith([&](const sheet::Workbook& now) {
            names = chooseNames(now, added);
            sheet::AddDatasets command;
            command.sheet = layout.sheet.empty() ? now.sheets.front().name : layout.sheet;
            command.columns = layout.columns;
            command.columnTitles = layout.columnTitles;
            command.rowTitles = layout.rowTitles;
            command.datasets = added;
            for (std::size_t i = 0; i < names.size(); ++i)
                command.datasets[i].name = names[i];
            command.place = requests.empty() || requests.front().place;
            return sheet::Command(std::move(command));
        });
        return names;
    }

    sheet::NamedDataset namedDataset(const ImportRequest& request) {
        if (request.files.empty())
            throw InvalidInput("import", "no file is named", "name at least one").withField("files");
        sheet::NamedDataset dataset;
        dataset.name = request.name;
        dataset.place = request.cell;
        for (const fs::path& file : request.files) {
            dataset.source.files.push_back(datasets.roots().resolve(file).string());
        }
        dataset.source.options = request.options.is_null() ? "{}" : request.options.dump();
        // Opening a file again is how a user tries again after a failure.
        datasets.ensure(dataset.source, true);
        return dataset;
    }

    static std::vector<std::string> chooseNames(const sheet::Workbook& now,
                                                const std::vector<sheet::NamedDataset>& added) {
        std::set<std::string> taken;
        for (const auto& [name, source] : now.datasets)
            taken.insert(name);
        std::vector<std::string> unnamed;
        for (const sheet::NamedDataset& each : added) {
            if (each.name.empty()) {
                unnamed.push_back(each.source.files.front());
            } else if (!taken.insert(each.name).second) {
                throw Conflict("dataset '" + each.name + "'", "the name is taken", "choose another one")
                    .withField("name");
            }
        }
        const std::vector<std::string> found = sheet::distinguishingNames(unnamed, taken);
        std::vector<std::string> names;
        auto next = found.begin();
        for (const sheet::NamedDataset& each : added)
            names.push_back(each.name.empty() ? *next++ : each.name);
        return names;
    }

    std::shared_ptr<const CellContents> contents(const sheet::Workbook& snapshot) {
        return datasets.contents(*keys, snapshot);
    }

    std::size_t indexOf(const sheet::Workbook& snapshot, const std::string& sheetName) const {
        return sheetName.empty() ? 0 : sheet::sheetIndex(snapshot, sheetName);
    }

    std::future<FrameResult> render(const std::vector<TileSpec>& specs, FramePriority priority,
                                    std::function<bool()> cancelled, PixelFormat format) const {
        if (!thread)
            throw Unsupported("pictures", "this engine was started without a renderer", "start it with one");
        return thread->submit({specs, format}, priority, std::move(cancelled));
    }

    EngineOptions options;
    std::shared_ptr<const sheet::KeyTable> keys;
    std::mutex listenerMutex;
    std::map<std::uint64_t, ChangeListener> listeners;
    std::uint64_t lastListener = 0;
    DatasetKeeper datasets;
    std::unique_ptr<RenderThread> thread;
    TileMaker tiles;
    ProbeService probes;
    WorkbookKeeper workbook;
};

Engine::Engine(EngineOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Engine::~Engine() = default;

std::vector<std::string> Engine::importDatasets(const std::vector<ImportRequest>& requests,
                                                const ImportLayout& layout) {
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
    if (state.meta && implementation_->thread) implementation_->thread->forget(state.meta->key);
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

void Engine::setWorkbookJson(const nlohmann::json& document, const fs::path& folder) {
    implementation_->workbook.replace(document, folder);
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
        statuses.push_back({address, content.state, content.code, content.message,
                            implementation_->datasets.progress(content), content.meta, content.notes});
    }
    return statuses;
}

PreparedTile Engine::prepareTile(const sheet::Workbook& workbook, const std::string& sheetName,
                                 const sheet::Address& cell, const View& view,
                                 const TileQuality& quality) const {
    const std::size_t index = implementation_->indexOf(workbook, sheetName);
    const auto contents = implementation_->contents(workbook);
    PreparedTile tile = implementation_->tiles.prepare(workbook, index, cell, view, quality, *contents);
    tile.progress = implementation_->datasets.progress(contentAt(*contents, {index, cell}));
    return tile;
}

std::future<FrameResult> Engine::render(const std::vector<TileSpec>& tiles, FramePriority priority,
                                        std::function<bool()> cancelled, PixelFormat format) const {
    return implementation_->render(tiles, priority, std::move(cancelled), format);
}

SheetImage Engine::renderSheet(const SheetImageRequest& request) const {
    const sheet::Snapshot now = snapshot();
    const SheetImageSources sources{keys(), implementation_->tiles,
                                    [this](const std::vector<TileSpec>& specs, PixelFormat format) {
                                        return render(specs, FramePriority::Export, {}, format).get();
                                    }};
    return composeSheet(request, *now, *implementation_->contents(*now), sources);
}

std::vector<ProbeValue> Engine::probeWorld(const std::string& sheetName, const glm::dvec3& world) const {
    const sheet::Snapshot now = snapshot();
    return implementation_->probes.atWorld(*now, implementation_->indexOf(*now, sheetName), {},
                                           *implementation_->contents(*now), world);
}

std::vector<ProbeValue> Engine::probePixel(const std::string& sheetName, const sheet::Address& cell,
                                           const View& view, glm::dvec2 pixel, glm::ivec2 sizePixels) const {
    const sheet::Snapshot now = snapshot();
    const std::size_t index = implementation_->indexOf(*now, sheetName);
    const auto contents = implementation_->contents(*now);
    TileQuality quality;
    quality.sizePixels = sizePixels;
    const PreparedTile tile = implementation_->tiles.prepare(*now, index, cell, view, quality, *contents);
    if (!tile.spec) return {};
    const DatasetMeta& meta = *contentAt(*contents, {index, cell}).meta;
    const auto world = implementation_->probes.underPixel(*tile.spec, meta, pixel);
    if (!world) return {};
    return implementation_->probes.atWorld(*now, index, view, *contents, *world);
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
    return describeColourBar(implementation_->tiles.look(*now, index, cell, view, *contents));
}

nlohmann::json Engine::colourMaps() const { return describeColourMaps(ColourMapTable::embedded()); }

const RenderDevice* Engine::device() const {
    return implementation_->thread ? &implementation_->thread->device() : nullptr;
}

ResidencyState Engine::residency() const {
    return implementation_->thread ? implementation_->thread->residency() : ResidencyState{};
}

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
