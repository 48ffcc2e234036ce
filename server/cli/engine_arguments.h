// Options that serve and render share: what to open, and what the engine may use.
#pragma once

#include "cli/import_arguments.h"
#include "engine/engine.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace voxsheet::cli {

struct EngineArguments {
    std::vector<std::string>
        sources; ///< one workbook (.json with a "voxsheet" member), or files and formulas
    std::vector<std::string> roots;
    std::string store;
    std::string storeLimit;
    std::string uploadDir;
    std::string textureBudget;
    std::string memoryBudget;
    int device = -1;
    std::vector<std::string> paths; ///< TECHNIQUE=PATH each
    std::optional<int> columns;
    std::string layout;
    bool series = false;
    ImportArguments import;
};

void addEngineArguments(CLI::App& app, EngineArguments& arguments);

/// Default folders: $XDG_CACHE_HOME or ~/.cache, then voxsheet/{store,uploads}. Throws InvalidInput for bad
/// sizes and paths.
[[nodiscard]] engine::EngineOptions engineOptions(const EngineArguments& arguments);

/// Where `bench calibrate` remembers its results, in the user's cache.
[[nodiscard]] std::filesystem::path calibrationFolder();

/// True for a JSON document with a "voxsheet" member (a raw file's sidecar has none). Throws NotFound,
/// IoError.
[[nodiscard]] bool isWorkbook(const std::filesystem::path& file);

/// Starts what the arguments name: the workbook, or the files and formulas (named_sources.h) placed by
/// --layout or --columns. A file that is not there or is damaged becomes an error in its cell. Throws
/// InvalidInput (mixed, or a layout that does not fit), NotFound (the workbook).
void openSources(engine::Engine& engine, const EngineArguments& arguments);

} // namespace voxsheet::cli
