// One file into one entry of the volume store.
#pragma once

#include "import/child/reader_registry.h"
#include "import/import_client.h"
#include "store/volume_store.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace voxsheet::import {

struct JobLimits {
    std::uint64_t memoryBytes = 0; ///< 0 = no limit
    std::uint64_t maxVoxelBytes = 64ULL << 30;
};

/// Reads the voxels and drops them. Throws as the readers.
[[nodiscard]] ReadingTime measureSource(const ReaderRegistry& readers, const std::filesystem::path& file,
                                        const ImportOptions& options, const JobLimits& limits);

/// The header phase: what is in the file, checked against its size; no voxel is read. Throws as the readers.
[[nodiscard]] FilePreview previewSource(const ReaderRegistry& readers, const std::filesystem::path& file,
                                        const ImportOptions& options, const JobLimits& limits);

struct ImportJob {
    std::vector<std::filesystem::path> files; ///< one, or a series in order (file_series.h)
    ImportOptions options;
    JobLimits limits;
    std::function<void(const FilePreview&)> header; ///< called once, before any voxel is read
    std::function<void(double)> progress;           ///< 0..1
};

/// Returns the entry's key. Throws as the readers; LimitExceeded if memory or the store's disk are too small
/// for what the header promises; IoError if a file changed meanwhile.
[[nodiscard]] std::string importIntoStore(const ReaderRegistry& readers, const store::VolumeStore& store,
                                          const ImportJob& job);

} // namespace voxsheet::import
