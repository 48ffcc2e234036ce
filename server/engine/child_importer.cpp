#include "engine/child_importer.h"

#include "engine/dataset_json.h"
#include "import/import_client.h"

namespace voxsheet::engine {

namespace {

// Spelt out in full: clang-format takes a line that begins with `import` for one of a C++20 module.
voxsheet::import::ImporterSettings settingsFrom(const EngineOptions& options) {
    voxsheet::import::ImporterSettings settings;
    settings.executable = options.importer;
    settings.storeFolder = options.storeDir;
    settings.storeLimitBytes = options.storeLimitBytes;
    settings.memoryLimitBytes = options.memoryBudgetBytes;
    return settings;
}

} // namespace

Importer childImporter(const EngineOptions& options) {
    return [settings = settingsFrom(options)](const std::vector<std::filesystem::path>& files,
                                              const nlohmann::json& importOptions,
                                              const JobControl& control) {
        return import::runImport(settings, {files, importOptions}, control.progress, control.cancelled).key;
    };
}

nlohmann::json previewByChild(const EngineOptions& options, const std::filesystem::path& file,
                              const nlohmann::json& importOptions) {
    const import::FilePreview preview = import::previewFile(settingsFrom(options), file, importOptions);
    nlohmann::json description = describeDataset(preview.meta);
    description["bytes"] = preview.voxelBytes;
    return description;
}

} // namespace voxsheet::engine
