#include "engine/dataset_keeper.h"

#include "base/errors.h"
#include "base/thread_count.h"

#include <algorithm>

namespace voxsheet::engine {

namespace {

int importWorkers() {
    // Imports are children that read and build with several threads of their own; more of them only fight
    // for memory.
    return std::clamp(threadCount().threads, 1, 4);
}

std::vector<std::filesystem::path> allowedFolders(const EngineOptions& options) {
    std::vector<std::filesystem::path> folders = options.roots;
    if (!options.uploadDir.empty()) folders.push_back(options.uploadDir);
    return folders;
}

/// Sizes and times of the files; a file that is not there has none.
std::string stampOf(const sheet::DatasetSource& source) {
    std::string text;
    for (const std::string& file : source.files) {
        std::error_code error;
        const auto bytes = std::filesystem::file_size(file, error);
        const auto time = std::filesystem::last_write_time(file, error);
        if (!error) text += std::to_string(bytes) + "@" + std::to_string(time.time_since_epoch().count());
        text += "\n";
    }
    return text;
}

} // namespace

DatasetKeeper::DatasetKeeper(const EngineOptions& options, Importer importer,
                             std::function<void(bool, const std::string&)> changed)
    : options_(options), importer_(std::move(importer)), changed_(std::move(changed)),
      roots_(allowedFolders(options)),
      store_(std::make_shared<const store::VolumeStore>(options.storeDir, options.storeLimitBytes)),
      volumes_(std::make_shared<store::StoreVolumeProvider>(store_)),
      imports_(importWorkers(), [this](const std::string& id, bool isSettled) { settled(isSettled, id); }),
      computations_(1, [this](const std::string&, bool isSettled) { settled(isSettled, {}); }) {}

void DatasetKeeper::settled(bool isSettled, const std::string& importId) {
    if (isSettled) ++generation_;
    changed_(isSettled, isSettled ? importId : std::string{});
}

std::string DatasetKeeper::idOf(const sheet::DatasetSource& source) {
    return nlohmann::json{{"files", source.files}, {"options", source.options}}.dump(
        -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void DatasetKeeper::ensure(const sheet::DatasetSource& source) {
    const std::string id = idOf(source);
    if (imports_.find(id)) return;
    {
        const std::lock_guard lock(stampMutex_);
        stamps_.try_emplace(id, stampOf(source));
    }
    imports_.ensure(id, [this, source](const JobControl& control) { return import(source, control); });
}

void DatasetKeeper::open(const sheet::DatasetSource& source) {
    const std::string id = idOf(source);
    const std::string stamp = stampOf(source);
    bool changed = false;
    {
        const std::lock_guard lock(stampMutex_);
        std::string& known = stamps_[id];
        changed = known != stamp;
        known = stamp;
    }
    imports_.ensureOrRetry(
        id, [this, source](const JobControl& control) { return import(source, control); }, changed);
}

JobState DatasetKeeper::state(const sheet::DatasetSource& source) {
    ensure(source);
    return imports_.find(idOf(source)).value();
}

void DatasetKeeper::cancel(const sheet::DatasetSource& source) { imports_.cancel(idOf(source)); }

std::shared_ptr<const DatasetMeta> DatasetKeeper::import(const sheet::DatasetSource& source,
                                                         const JobControl& control) {
    std::vector<std::filesystem::path> files;
    for (const std::string& file : source.files)
        files.push_back(roots_.resolve(file));
    const std::string key = importer_(files, nlohmann::json::parse(source.options), control);
    return volumes_->describe(key);
}

std::shared_ptr<const CellContents> DatasetKeeper::contents(const sheet::KeyTable& keys,
                                                            const sheet::Workbook& workbook) {
    const std::uint64_t generation = generation_;
    {
        const std::lock_guard lock(cacheMutex_);
        if (cached_.contents && cached_.version == workbook.version && cached_.generation == generation) {
            return cached_.contents;
        }
    }
    ContentSources sources;
    sources.import = [&](const std::string& name) {
        const sheet::DatasetSource& source = workbook.datasets.at(name);
        return std::pair(idOf(source), state(source));
    };
    sources.formula = [&](const FormulaTask& task) {
        const std::string id = formulaEntryKey(task);
        computations_.ensure(id, [this, task](const JobControl& control) {
            return readable(computeFormula(task, *store_, *volumes_, options_.memoryBudgetBytes, control));
        });
        return std::pair(id, computations_.find(id).value());
    };
    auto made = std::make_shared<const CellContents>(evaluateContents(keys, workbook, sources));
    const std::lock_guard lock(cacheMutex_);
    cached_ = {workbook.version, generation, made};
    return made;
}

JobResult DatasetKeeper::readable(ComputedEntry made) {
    const auto shared = std::make_shared<ComputedEntry>(std::move(made));
    volumes_->adopt(shared->entry());
    return {shared->meta(), [this, shared] {
                // Another process's entry is read instead of this one, which then can go.
                bool stays = false;
                try {
                    stays = shared->commit();
                } catch (...) {
                    volumes_->forget(shared->meta()->key);
                    throw;
                }
                if (!stays) volumes_->forget(shared->meta()->key);
            }};
}

JobState DatasetKeeper::threshold(const std::string& asker, const ThresholdTask& task) {
    const std::string id = thresholdEntryKey(task);
    want(asker, id);
    while (true) {
        computations_.ensure(id, [this, task](const JobControl& control) {
            return readable(computeThreshold(task, *store_, *volumes_, options_.memoryBudgetBytes, control));
        });
        // Another thread may have dropped it in between.
        if (const auto state = computations_.find(id)) return *state;
    }
}

void DatasetKeeper::releaseThreshold(const std::string& asker) { want(asker, {}); }

void DatasetKeeper::want(const std::string& asker, const std::string& thresholdId) {
    std::string dropped;
    {
        const std::lock_guard lock(wantedMutex_);
        const auto known = wantedThresholds_.find(asker);
        if (known != wantedThresholds_.end()) {
            if (known->second == thresholdId) return;
            dropped = known->second;
            wantedThresholds_.erase(known);
        }
        if (!thresholdId.empty()) wantedThresholds_[asker] = thresholdId;
        const bool stillWanted = std::any_of(wantedThresholds_.begin(), wantedThresholds_.end(),
                                             [&](const auto& each) { return each.second == dropped; });
        if (stillWanted) dropped.clear();
    }
    if (!dropped.empty()) computations_.dropQueued(dropped);
}

double DatasetKeeper::progress(const CellContent& content) const {
    if (content.state != CellState::Pending) return 1.0;
    const auto state = (content.computing ? computations_ : imports_).find(content.job);
    return state ? std::min(state->progress, 0.999) : 0.0;
}

void DatasetKeeper::stop() {
    imports_.stop();
    computations_.stop();
}

bool DatasetKeeper::waitIdle(double seconds) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    const auto left = [&] {
        return std::chrono::duration<double>(deadline - std::chrono::steady_clock::now()).count();
    };
    // An import that ends may start a formula, and a formula a threshold.
    while (!(imports_.idle() && computations_.idle())) {
        if (!imports_.waitIdle(std::max(0.0, left())) || !computations_.waitIdle(std::max(0.0, left())))
            return false;
    }
    return true;
}

} // namespace voxsheet::engine
