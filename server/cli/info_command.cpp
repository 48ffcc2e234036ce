#include "base/errors.h"
#include "cli/commands.h"
#include "cli/engine_arguments.h"
#include "cli/exit_codes.h"
#include "cli/named_sources.h"
#include "engine/dataset_json.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace voxsheet::cli {

namespace {

struct InfoArguments {
    EngineArguments engine;
    bool json = false;
};

std::string joined(const nlohmann::json& list, const char* separator) {
    std::string text;
    for (const auto& item : list)
        text += (text.empty() ? "" : separator) + item.dump();
    return text;
}

/// "104: liver, spleen, left kidney, …"
std::string labelsText(const nlohmann::json& labels) {
    constexpr std::size_t shown = 8;
    std::string text = std::to_string(labels.size()) + ":";
    for (std::size_t i = 0; i < std::min(shown, labels.size()); ++i)
        text += (i == 0 ? " " : ", ") + labels[i]["name"].get<std::string>();
    return text + (labels.size() > shown ? ", …" : "");
}

void printText(const std::string& file, const nlohmann::json& info) {
    std::printf("%s\n", file.c_str());
    const auto row = [](const char* name, const std::string& value) {
        if (!value.empty()) std::printf("  %-10s %s\n", name, value.c_str());
    };
    const auto length = info["units"]["length"].get<std::string>();
    row("format", info["format"].get<std::string>());
    row("dims", joined(info["dims"], " x ") + " samples of " + info["type"].get<std::string>());
    row("spacing", joined(info["spacing"], ", ") + " " + length);
    row("origin", joined(info["origin"], ", ") + " " + length);
    row("periodic", info["periodic"].get<bool>() ? "yes" : "");
    row("steps", std::to_string(info["steps"].get<int>()));
    for (const auto& field : info["fields"])
        row("field", field["name"].get<std::string>() + ": " + joined(field["range"], " to ") + " " +
                         field["unit"].get<std::string>());
    if (info.contains("labels")) row("labels", labelsText(info["labels"]));
    if (info.contains("atoms")) row("atoms", std::to_string(info["atoms"].size()));
    for (const auto& note : info["notes"])
        row("note", note.get<std::string>());
}

/// Imports one file, or one series (into the store, where a later `serve` finds it) and describes it. Throws
/// what fails.
nlohmann::json describeFiles(engine::Engine& engine, const std::vector<std::string>& files,
                             const ImportArguments& import) {
    engine::ImportRequest request;
    request.options = importOptionsFor(import, files.front());
    for (const auto& file : files)
        request.files.push_back(std::filesystem::absolute(file));
    request.place = false;
    const auto name = engine.importDatasets({request}).at(0);
    engine.waitIdle(24 * 3600.0);
    const auto dataset = engine.dataset(name);
    if (dataset.failure) throw std::runtime_error(dataset.failure->message);
    auto info = engine::describeDataset(*dataset.meta);
    info["file"] = files.front();
    return info;
}

int runInfo(const InfoArguments& arguments) {
    auto options = engineOptions(arguments.engine);
    options.render = false;
    engine::Engine engine(options);
    int code = kExitDone;
    nlohmann::json all = nlohmann::json::array();
    auto words = arguments.engine.sources;
    const auto series = arguments.engine.series ? takeSeries(words) : SeriesFiles{};
    for (const auto& file : words) {
        try {
            const auto found = series.find(file);
            auto info = describeFiles(engine, found == series.end() ? std::vector{file} : found->second,
                                      arguments.engine.import);
            if (!arguments.json) printText(file, info);
            all.push_back(std::move(info));
        } catch (const Error& error) {
            code = reportFailure(error);
        } catch (const std::exception& error) {
            code = reportFailure(std::string(error.what()));
        }
    }
    // One object for one file; a list for several.
    if (arguments.json && !all.empty())
        std::printf("%s\n", (words.size() == 1 ? all[0] : all).dump(2).c_str());
    return code;
}

} // namespace

Action addInfo(CLI::App& app) {
    auto arguments = std::make_shared<InfoArguments>();
    addEngineArguments(app, arguments->engine);
    app.get_option("SOURCES")->required()->description("Data files");
    app.add_flag("--json", arguments->json, "JSON on stdout: one object for one file, a list for several");
    app.footer("Example: voxsheet info scan.nii.gz --json");
    return [arguments] { return runInfo(*arguments); };
}

} // namespace voxsheet::cli
