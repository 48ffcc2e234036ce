// Volumes that benches show: deterministic, all different.
#pragma once

#include "engine/engine.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::cli {

/// Writes `count` NRRD files of dim^3 8-bit samples (Marschner-Lobb signals, each turned to another phase).
/// Files that are there already and have the right size are left alone, so that their imports are still
/// known.
[[nodiscard]] std::vector<std::string> writeBenchVolumes(const std::filesystem::path& folder, int count,
                                                         int dim);

/// Of an engine that reads, stores and takes uploads in the bench's own folder only.
[[nodiscard]] engine::EngineOptions benchEngineOptions(const std::filesystem::path& folder, int device);

} // namespace voxsheet::cli
