#include "engine/engine_implementation.h"

#include "base/host_memory.h"
#include "base/log.h"
#include "engine/child_importer.h"
#include "engine/colour_map.h"
#include "engine/config_files.h"
#include "engine/path_memory.h"
#include "engine/shown_volumes.h"
#include "engine/tile_identity.h"
#include "sheet/dataset_names.h"
#include "store/volume_store.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

#include <unistd.h>

namespace voxsheet::engine {

namespace {

namespace fs = std::filesystem;

EngineOptions completed(EngineOptions options) {
    if (options.storeDir.empty()) options.storeDir = store::defaultStoreFolder();
    if (options.uploadDir.empty()) options.uploadDir = options.storeDir.parent_path() / "uploads";
    if (options.recoveryDir.empty()) options.recoveryDir = options.uploadDir;
    if (options.memoryBudgetBytes == 0) {
        options.memoryBudgetBytes = hostMemoryBytes() / 4;
    }
    if (options.storeLimitBytes == 0) options.storeLimitBytes = 20ULL << 30U;
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

/// Keeps nothing as long as all textures fit: a second copy would be of no use.
std::shared_ptr<HostVolumeCache> makeHostCache(const EngineOptions& options,
                                               std::shared_ptr<const VolumeProvider> volumes) {
    return std::make_shared<HostVolumeCache>(std::move(volumes),
                                             HostCacheOptions{.budgetBytes = options.memoryBudgetBytes,
                                                              .pageCache = PageCacheUse::DropOverBudget,
                                                              .keep = false});
}

std::unique_ptr<RenderThread> renderThread(const EngineOptions& options,
                                           const std::shared_ptr<HostVolumeCache>& volumes) {
    if (!options.render) return nullptr;
    RenderOptions rendering;
    rendering.device = options.device;
    rendering.textureBudgetBytes = options.textureBudgetBytes;
    rendering.onFirstEviction = [volumes] { volumes->keepFromNowOn(); };
    rendering.choosePaths = [&options](const RenderDevice& device) {
        const auto rule = pathsByRule(gpu::workaroundsNamed(device.workarounds));
        return choosePaths(rule, rememberedPaths(options.calibrationDir, device), options.paths);
    };
    return std::make_unique<RenderThread>(volumes, rendering);
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

DeviceForms formsOf(const RenderThread* thread) {
    if (thread == nullptr) return {};
    return {gpu::workaroundsNamed(thread->device().workarounds), pathsOf(thread->paths())};
}

NamedVolumeSources namedVolumeSources(DatasetKeeper& datasets) {
    NamedVolumeSources sources;
    sources.import = [&datasets](const sheet::DatasetSource& source) { return datasets.state(source); };
    sources.threshold = [&datasets](const std::string& asker, const ThresholdTask& task) {
        return datasets.threshold(asker, task);
    };
    sources.release = [&datasets](const std::string& asker) { datasets.releaseThreshold(asker); };
    sources.progress = [&datasets](const CellContent& content) { return datasets.progress(content); };
    return sources;
}

} // namespace

Engine::Implementation::Implementation(EngineOptions given)
    : options(completed(std::move(given))), keys(keyTable()),
      presets(sheet::parseStylePresets(configFile("style_presets.json"), *keys)),
      datasets(options, childImporter(options),
               [this](bool settled, const std::string& importId) { datasetsChanged(settled, importId); }),
      hostCache(makeHostCache(options, datasets.volumes())), thread(renderThread(options, hostCache)),
      tiles(*keys, ColourMapTable::embedded(), datasets.volumes(), namedVolumeSources(datasets),
            {environmentOf(thread.get()), formsOf(thread.get())}),
      probes(*keys, datasets.volumes()),
      workbook(keys, options, [this](std::uint64_t version) { workbookChanged(version); }) {}

Engine::Implementation::~Implementation() { datasets.stop(); }

void Engine::Implementation::workbookChanged(std::uint64_t version) {
    // Starts the imports and formulas that the new snapshot needs.
    static_cast<void>(datasets.contents(*keys, *workbook.snapshot()));
    notify(ChangeKind::Workbook, version);
}

void Engine::Implementation::datasetsChanged(bool settled, const std::string& importId) {
    const sheet::Snapshot now = workbook.snapshot();
    if (settled) {
        static_cast<void>(datasets.contents(*keys, *now));
        if (!importId.empty()) noteSource(*now, importId);
    }
    notify(ChangeKind::Datasets, now->version);
}

void Engine::Implementation::noteSource(const sheet::Workbook& now, const std::string& importId) {
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

void Engine::Implementation::notify(ChangeKind kind, std::uint64_t version) {
    std::vector<ChangeListener> called;
    {
        const std::lock_guard lock(listenerMutex);
        for (const auto& [id, listener] : listeners)
            called.push_back(listener);
    }
    for (const ChangeListener& listener : called)
        listener(kind, version);
}

DatasetInfo Engine::Implementation::infoOf(const std::string& name, const sheet::DatasetSource& source) {
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

const sheet::DatasetSource& Engine::Implementation::sourceOf(const sheet::Workbook& now,
                                                             const std::string& name) {
    const auto found = now.datasets.find(name);
    if (found == now.datasets.end()) {
        throw NotFound("dataset '" + name + "'", "there is no such dataset in the workbook",
                       "list the datasets");
    }
    return found->second;
}

std::vector<std::string> Engine::Implementation::import(const std::vector<ImportRequest>& requests,
                                                        const ImportLayout& layout) {
    std::vector<sheet::NamedDataset> added;
    for (const ImportRequest& request : requests)
        added.push_back(namedDataset(request));
    // One that is named and read from the same files as before stays where it is, with its new values.
    const sheet::Snapshot before = workbook.snapshot();
    const auto isKnown = [&](const sheet::NamedDataset& each) {
        const auto known = before->datasets.find(each.name);
        return known != before->datasets.end() &&
               DatasetKeeper::idOf(known->second) == DatasetKeeper::idOf(each.source);
    };
    std::vector<sheet::NamedDataset> fresh;
    std::copy_if(added.begin(), added.end(), std::back_inserter(fresh), std::not_fn(isKnown));
    std::vector<std::string> freshNames;
    if (!fresh.empty())
        workbook.applyWith([&](const sheet::Workbook& now) {
            freshNames = chooseNames(now, fresh);
            sheet::AddDatasets command;
            command.sheet = layout.sheet.empty() ? now.sheets.front().name : layout.sheet;
            command.columns = layout.columns;
            command.columnTitles = layout.columnTitles;
            command.rowTitles = layout.rowTitles;
            command.datasets = fresh;
            for (std::size_t i = 0; i < freshNames.size(); ++i)
                command.datasets[i].name = freshNames[i];
            command.place = requests.empty() || requests.front().place;
            return sheet::Command(std::move(command));
        });
    std::vector<std::string> names;
    auto next = freshNames.begin();
    for (const auto& each : added) {
        // Opening a file again is how a user tries again after a failure, or reads what has changed.
        datasets.open(each.source);
        names.push_back(isKnown(each) ? each.name : *next++);
    }
    return names;
}

sheet::NamedDataset Engine::Implementation::namedDataset(const ImportRequest& request) {
    if (request.files.empty())
        throw InvalidInput("import", "no file is named", "name at least one").withField("files");
    sheet::NamedDataset dataset;
    dataset.name = request.name;
    dataset.place = request.cell;
    for (const fs::path& file : request.files) {
        dataset.source.files.push_back(datasets.roots().resolve(file).string());
    }
    dataset.source.options = request.options.is_null() ? "{}" : request.options.dump();
    return dataset;
}

std::vector<std::string> Engine::Implementation::chooseNames(const sheet::Workbook& now,
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

std::shared_ptr<const CellContents> Engine::Implementation::contents(const sheet::Workbook& snapshot) {
    return datasets.contents(*keys, snapshot);
}

std::size_t Engine::Implementation::indexOf(const sheet::Workbook& snapshot, const std::string& sheetName) {
    return sheetName.empty() ? 0 : sheet::sheetIndex(snapshot, sheetName);
}

ProbeService::LayersOf Engine::Implementation::layersOf(const sheet::Workbook& snapshot,
                                                        std::size_t sheetIndex, const View& view,
                                                        const std::shared_ptr<const CellContents>& contents) {
    return [this, &snapshot, sheetIndex, &view, contents](const sheet::Address& cell) {
        return tiles.look(snapshot, sheetIndex, cell, view, contents).layers;
    };
}

std::future<FrameResult> Engine::Implementation::render(FrameSpec frame, FramePriority priority,
                                                        std::function<bool()> cancelled) const {
    if (!thread)
        throw Unsupported("pictures", "this engine was started without a renderer", "start it with one");
    return thread->submit(std::move(frame), priority, std::move(cancelled));
}

} // namespace voxsheet::engine
