// What the server sees of importing: a child process per import, its limits, and one clear sentence when it
// fails.
#pragma once

#include "volume/dataset.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace voxsheet::import {

/// How importer processes are run. The defaults suit a workstation.
struct ImporterSettings {
    std::filesystem::path executable;          ///< empty: voxsheet-import in the folder of this program
    std::filesystem::path storeFolder;         ///< of the volume store
    std::uint64_t storeLimitBytes = 0;         ///< 0 = none
    std::uint64_t memoryLimitBytes = 0;        ///< of one child; 0 = half of the machine's memory
    std::uint64_t maxVoxelBytes = 64ULL << 30; ///< of level 0 of one dataset, all fields and steps
    double headerCpuSeconds =
        1.5; ///< processor time until the header is understood, plus 1 s per 100 MB of file
    double headerWallSeconds = 10.0; ///< the same by the clock: a disk may take seconds to answer
    double blockedHeaderSeconds =
        1.5; ///< longest time asleep in the header with nothing done and no disk to wait for
    double blockedDataSeconds =
        10.0; ///< the same while voxels are read: the source is good, a remote folder may pause
    double stallSeconds = 120.0;  ///< longest time without progress while voxels are read
    double totalSeconds = 3600.0; ///< of one import
};

struct ImportRequest {
    std::vector<std::filesystem::path> files; ///< one dataset from these: a file, or a series in order
    nlohmann::json options = nlohmann::json::object(); ///< see import_options_json.h
};

struct ImportResult {
    std::string key; ///< of the entry in the volume store; it is whole and can be opened
};

using ImportProgress = std::function<void(double fraction)>; ///< 0..1, never decreasing
using ImportCancelled = std::function<bool()>;

/// Imports into the volume store; returns at once if the store has the entry already. Blocks; thread-safe.
/// `progress` and `cancelled` are called on this thread, the latter about 20 times a second.
/// Throws what the child reports (InvalidInput, NotFound, Unsupported, LimitExceeded, IoError), Cancelled,
/// InvalidInput if the child crashed (the file is probably damaged), LimitExceeded if it hung or used up its
/// memory or time, IoError if it cannot be started. The subject is the file.
ImportResult runImport(const ImporterSettings& settings, const ImportRequest& request,
                       const ImportProgress& progress = {}, const ImportCancelled& cancelled = {});

/// How long a file takes to read, for benches: nothing goes into the store.
struct ReadingTime {
    double headerSeconds = 0.0; ///< until the header is understood and checked
    double dataSeconds = 0.0;   ///< from there until the last voxel is in memory
    std::uint64_t voxelBytes = 0;
};

/// Times one reading within an importer process; the process's start does not count. Throws as runImport.
[[nodiscard]] ReadingTime measureReading(const ImporterSettings& settings, const std::filesystem::path& file,
                                         const nlohmann::json& options = nlohmann::json::object());

/// What a header says; no voxel was read.
struct FilePreview {
    DatasetMeta meta;               ///< fields without statistics; no key
    std::uint64_t voxelBytes = 0;   ///< of level 0, all fields and steps
    std::vector<std::string> files; ///< that the voxels depend on, the opened one first
};

/// Throws as runImport.
[[nodiscard]] FilePreview previewFile(const ImporterSettings& settings, const std::filesystem::path& file,
                                      const nlohmann::json& options = nlohmann::json::object());

/// Many files with one child (a new one after a crash); a file that fails has its exception (an Error) in its
/// place.
[[nodiscard]] std::vector<std::variant<FilePreview, std::exception_ptr>>
previewFiles(const ImporterSettings& settings, const std::vector<std::filesystem::path>& files,
             const nlohmann::json& options = nlohmann::json::object(), const ImportCancelled& cancelled = {});

} // namespace voxsheet::import
