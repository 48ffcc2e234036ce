// Datasets, formula results and thresholds of the running engine: from sources to entries of the volume
// store.
#pragma once

#include "engine/cell_contents.h"
#include "engine/computed_entry.h"
#include "engine/engine.h"
#include "engine/entry_jobs.h"
#include "engine/source_files.h"
#include "engine/threshold_job.h"
#include "store/store_volume_provider.h"
#include "store/volume_store.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace voxsheet::engine {

/// Makes an entry of the volume store from files and returns its key; the real one runs voxsheet-import.
using Importer = std::function<std::string(const std::vector<std::filesystem::path>& files,
                                           const nlohmann::json& options, const JobControl& control)>;

/// Thread-safe.
class DatasetKeeper {
public:
    /// \param settled  called on a worker's thread: progress (empty source), or the source of an import that
    /// is ready or failed; formulas settle with an empty source, too
    DatasetKeeper(const EngineOptions& options, Importer importer,
                  std::function<void(bool settled, const std::string& importId)> changed);

    /// The id under which a source is imported: its files and options.
    [[nodiscard]] static std::string idOf(const sheet::DatasetSource& source);
    /// Starts the import unless it is known.
    void ensure(const sheet::DatasetSource& source);
    /// A user opened the source: starts it again if it failed before, or if a file changed since it was
    /// imported.
    void open(const sheet::DatasetSource& source);
    [[nodiscard]] JobState state(const sheet::DatasetSource& source);
    void cancel(const sheet::DatasetSource& source);

    /// Starts what the workbook needs and tells what its cells hold. Computed once per version and change
    /// of a job.
    [[nodiscard]] std::shared_ptr<const CellContents> contents(const sheet::KeyTable& keys,
                                                               const sheet::Workbook& workbook);
    /// Starts the computation unless it is known. `asker` wants this one and no other any more: what only it
    /// wanted and what has not begun is dropped, so that dragging a threshold does not queue every value.
    [[nodiscard]] JobState threshold(const std::string& asker, const ThresholdTask& task);
    /// `asker` wants no threshold any more.
    void releaseThreshold(const std::string& asker);

    /// [0, 1) of what a pending cell waits for.
    [[nodiscard]] double progress(const CellContent& content) const;

    /// Cancels all work and waits for it; `changed` is not called afterwards.
    void stop();
    [[nodiscard]] bool waitIdle(double seconds) const;
    [[nodiscard]] const std::shared_ptr<store::StoreVolumeProvider>& volumes() const { return volumes_; }
    [[nodiscard]] const SourceRoots& roots() const { return roots_; }

private:
    [[nodiscard]] std::shared_ptr<const DatasetMeta> import(const sheet::DatasetSource& source,
                                                            const JobControl& control);
    /// Its pictures need not wait until it is written durably.
    [[nodiscard]] JobResult readable(ComputedEntry made);
    void settled(bool isSettled, const std::string& importId);
    /// Remembers what `asker` wants (empty: nothing) and drops what nobody wants any more.
    void want(const std::string& asker, const std::string& thresholdId);

    EngineOptions options_;
    Importer importer_;
    std::function<void(bool, const std::string&)> changed_;
    SourceRoots roots_;
    std::shared_ptr<const store::VolumeStore> store_;
    std::shared_ptr<store::StoreVolumeProvider> volumes_;
    std::atomic<std::uint64_t> generation_{1}; ///< counts jobs that settled
    std::mutex stampMutex_;
    std::map<std::string, std::string>
        stamps_; ///< by id: sizes and times of the files when the import was started
    std::mutex cacheMutex_;
    struct Cached {
        std::uint64_t version = 0;
        std::uint64_t generation = 0;
        std::shared_ptr<const CellContents> contents;
    };
    Cached cached_;
    std::mutex wantedMutex_;
    std::map<std::string, std::string> wantedThresholds_; ///< id of the job, by who asked last
    EntryJobs imports_;                                   ///< last: their threads use everything above
    EntryJobs computations_;                              ///< formulas and thresholds
};

} // namespace voxsheet::engine
