// Imports by the child process voxsheet-import.
#pragma once

#include "engine/dataset_keeper.h"
#include "engine/engine.h"

namespace voxsheet::engine {

[[nodiscard]] Importer childImporter(const EngineOptions& options);

/// Header-only look at a file: {format, dims, spacing, type, …} as describeDataset, without statistics.
/// Throws as import::previewFile.
[[nodiscard]] nlohmann::json previewByChild(const EngineOptions& options, const std::filesystem::path& file,
                                            const nlohmann::json& importOptions);

} // namespace voxsheet::engine
