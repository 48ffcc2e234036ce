#include "cli/engine_arguments.h"

#include "base/byte_size.h"
#include "base/errors.h"
#include "base/host_memory.h"
#include "cli/named_sources.h"
#include "cli/thread_arguments.h"
#include "sheet/bounded_json.h"
#include "sheet/workbook_json.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

namespace voxsheet::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMaxWorkbookBytes = 16U << 20U;

fs::path cacheFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
        return fs::path(cache) / "voxsheet";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".cache" / "voxsheet";
    return fs::temp_directory_path() / "voxsheet";
}

std::string readText(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) throw NotFound(file.string(), "there is no such file", "check the path");
    const auto bytes = fs::file_size(file, error);
    if (error || bytes > kMaxWorkbookBytes)
        throw InvalidInput(file.string(), "a workbook is a regular file of at most 16 MiB");
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) throw IoError(file.string(), "could not be read");
    return text;
}

bool endsInJson(const std::string& name) {
    return name.size() > 5 && name.substr(name.size() - 5) == ".json";
}

/// Folders that a workbook's sources lie in, read leniently: opening it says what is wrong with it.
std::vector<fs::path> sourceFolders(const fs::path& workbook) {
    std::vector<fs::path> folders;
    const auto document = nlohmann::json::parse(readText(workbook), nullptr, false);
    const auto datasets =
        document.is_object() ? document.value("datasets", nlohmann::json::object()) : nlohmann::json();
    if (!datasets.is_object()) return folders;
    for (const auto& dataset : datasets) {
        const auto files =
            dataset.is_object() ? dataset.value("files", nlohmann::json::array()) : nlohmann::json();
        for (const auto& file : files)
            if (file.is_string())
                folders.push_back(
                    (workbook.parent_path() / file.get<std::string>()).lexically_normal().parent_path());
    }
    return folders;
}

} // namespace

void addEngineArguments(CLI::App& app, EngineArguments& arguments) {
    app.add_option("SOURCES", arguments.sources,
                   "One workbook (.json), or data files and formulas over cells, e.g. a.nrrd b.nrrd =B1-A1");
    app.add_option(
        "--root", arguments.roots,
        "Folder that datasets may be opened from; repeatable (default: the working directory and the "
        "folders of the named files)");
    app.add_option("--store", arguments.store,
                   "Folder of the volume store, a cache (default: in the user's cache)");
    app.add_option("--store-limit", arguments.storeLimit, "Bytes the store may take, e.g. 20G");
    app.add_option("--upload-dir", arguments.uploadDir, "Folder that uploaded files are kept in");
    app.add_option("--texture-budget", arguments.textureBudget,
                   "Bytes of textures, e.g. 512M or 1GiB (default: six tenths of the GPU's memory; a quarter "
                   "of RAM where there is none)");
    app.add_option("--memory-budget", arguments.memoryBudget,
                   "Bytes of samples kept in host memory, and what one import or formula may take (default: "
                   "a quarter of RAM)");
    addThreadArgument(app);
    app.add_option("--device", arguments.device, "EGL device to draw on (default: chosen; see GET /api/v1)")
        ->check(CLI::Range(-1, 1024));
    app.add_option("--path", arguments.paths,
                   "Draw a technique by this path, e.g. raycast=shader; repeatable (default: by rule, or as "
                   "`voxsheet bench calibrate` found; see GET /api/v1)")
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--columns", arguments.columns,
                   "Columns of the sheet (default: chosen by the number of files)")
        ->check(CLI::Range(1, 1024));
    app.add_option("--layout", arguments.layout, "Place files by their names, e.g. 'sub-{row}_{col}.nii.gz'");
    app.add_flag(
        "--series", arguments.series,
        "Numbered files (slice_001.tif, slice_002.tif, …) are one dataset: slices make a volume, volumes are "
        "time steps");
    addImportArguments(app, arguments.import);
}

fs::path calibrationFolder() { return cacheFolder() / "calibration"; }

engine::EngineOptions engineOptions(const EngineArguments& arguments) {
    engine::EngineOptions options;
    options.storeDir = arguments.store.empty() ? cacheFolder() / "store" : fs::path(arguments.store);
    options.uploadDir =
        arguments.uploadDir.empty() ? cacheFolder() / "uploads" : fs::path(arguments.uploadDir);
    options.storeLimitBytes = parseBytes(arguments.storeLimit, "--store-limit");
    // The device's memory is known once it is open: what is above it is refused then.
    options.textureBudgetBytes = parseBudget(arguments.textureBudget, "--texture-budget", std::nullopt);
    options.memoryBudgetBytes = parseBudget(arguments.memoryBudget, "--memory-budget", hostMemoryBytes());
    options.device = arguments.device;
    options.calibrationDir = calibrationFolder();
    options.paths = parseForcedPaths(arguments.paths);
    std::set<fs::path> roots;
    const auto addRoot = [&](const fs::path& folder) {
        if (roots.insert(folder.lexically_normal()).second)
            options.roots.push_back(folder.lexically_normal());
    };
    if (arguments.roots.empty()) addRoot(fs::current_path());
    for (const auto& root : arguments.roots)
        addRoot(fs::absolute(root));
    if (arguments.roots.empty())
        for (const auto& source : arguments.sources)
            if (!isFormula(source)) addRoot(fs::absolute(source).lexically_normal().parent_path());
    if (arguments.sources.size() == 1 && !isFormula(arguments.sources.front()) &&
        isWorkbook(arguments.sources.front())) {
        options.workbookFile = fs::absolute(arguments.sources.front());
        // Whoever names a workbook on the command line means its data too, wherever that lies.
        if (arguments.roots.empty())
            for (const auto& folder : sourceFolders(options.workbookFile))
                addRoot(folder);
    }
    return options;
}

bool isWorkbook(const fs::path& file) {
    if (!endsInJson(file.string())) return false;
    const auto text = readText(file);
    const auto document = nlohmann::json::parse(text, nullptr, false);
    return document.is_object() && document.contains("voxsheet");
}

void openSources(engine::Engine& engine, const EngineArguments& arguments) {
    if (arguments.sources.empty()) return;
    const bool several = arguments.sources.size() > 1;
    const auto& first = arguments.sources.front();
    const auto existing = [](const std::string& path) { return !isFormula(path) && fs::exists(path); };
    const auto books = std::count_if(arguments.sources.begin(), arguments.sources.end(),
                                     [&](const auto& path) { return existing(path) && isWorkbook(path); });
    if (books > 0 && several)
        throw InvalidInput(first, "a workbook can not be opened together with other files or formulas",
                           "name one workbook, or only data files and formulas");
    if (books == 1) {
        if (!arguments.import.settings.empty())
            throw InvalidInput(first, "a workbook says itself how its files are to be read",
                               "change the options of its datasets, or name the data files")
                .withField("--import");
        const auto document = sheet::parseBoundedJson(readText(first), first);
        engine.setWorkbookJson(document, fs::absolute(first).parent_path(), engine::DocumentOrigin::File);
        return;
    }
    auto workbook =
        workbookOfWords(arguments.sources, {arguments.columns, arguments.layout, arguments.series},
                        fs::current_path(), engine.keys());
    setImportOptions(workbook, arguments.import);
    engine.setWorkbookJson(sheet::workbookToJson(workbook), fs::current_path(), engine::DocumentOrigin::File);
}

} // namespace voxsheet::cli
