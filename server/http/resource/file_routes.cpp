#include "base/errors.h"
#include "engine/source_files.h"
#include "http/resource/api_context.h"
#include "http/resource/folder_listing.h"
#include "http/resource/format_guess.h"
#include "http/route/json_answer.h"

#include <algorithm>
#include <chrono>

namespace voxsheet::http {

namespace fs = std::filesystem;

namespace {

constexpr auto kGuessTime =
    std::chrono::milliseconds(500); ///< for the formats of one listing; a network disk may be slow

nlohmann::json rootsJson(const engine::SourceRoots& roots) {
    auto list = nlohmann::json::array();
    for (const auto& root : roots.folders())
        list.push_back(root.string());
    return list;
}

/// Canonical, below a root. Outside is told apart from absent for nobody: which files exist elsewhere is no
/// one's business.
fs::path folderBelowRoots(const engine::SourceRoots& roots, const std::string& text) {
    std::error_code error;
    const auto folder = fs::canonical(text, error);
    const bool below =
        !error && std::any_of(roots.folders().begin(), roots.folders().end(),
                              [&](const fs::path& root) { return engine::isBelow(folder, root); });
    if (!fs::path(text).is_absolute() || !below || !fs::is_directory(folder, error))
        throw NotFound("folder '" + text + "'",
                       "there is no such folder below the folders that this server may open",
                       "start the server with --root DIR to add one")
            .withField("path");
    return folder;
}

nlohmann::json entryJson(const FolderEntry& entry, bool guess) {
    nlohmann::json out{{"name", entry.name},
                       {"path", entry.path.string()},
                       {"kind", entry.folder ? "folder" : "file"},
                       {"format", nullptr},
                       {"preview", nullptr}};
    if (entry.folder) return out;
    out["bytes"] = entry.bytes;
    if (!entry.files.empty()) {
        auto files = nlohmann::json::array();
        for (const auto& file : entry.files)
            files.push_back(file.string());
        out["count"] = entry.files.size();
        out["files"] = std::move(files);
    }
    if (guess)
        if (const auto format = guessFormat(entry.path)) out["format"] = *format;
    return out;
}

nlohmann::json parentJson(const engine::SourceRoots& roots, const fs::path& folder) {
    const auto& folders = roots.folders();
    // Above a root there is only the list of roots, which is the empty path.
    if (std::find(folders.begin(), folders.end(), folder) != folders.end()) return "";
    return folder.parent_path().string();
}

Response listRoots(const engine::SourceRoots& roots) {
    auto entries = nlohmann::json::array();
    for (const auto& root : roots.folders())
        entries.push_back({{"name", root.string()},
                           {"path", root.string()},
                           {"kind", "folder"},
                           {"format", nullptr},
                           {"preview", nullptr}});
    return jsonAnswer(nlohmann::json{{"path", ""},
                                     {"parent", nullptr},
                                     {"roots", rootsJson(roots)},
                                     {"entries", std::move(entries)},
                                     {"truncated", false}});
}

Response listFiles(const ApiContext& context, const Request& request) {
    const engine::SourceRoots roots(context.engine.options().roots);
    const auto path = request.query.text("path").value_or("");
    if (path.empty()) return listRoots(roots);
    const auto folder = folderBelowRoots(roots, path);
    const auto listing = listFolder(folder, roots.folders(), request.query.text("glob").value_or(""),
                                    request.query.boolean("series").value_or(true));
    auto entries = nlohmann::json::array();
    const auto until = std::chrono::steady_clock::now() + kGuessTime;
    for (const auto& entry : listing.entries)
        entries.push_back(entryJson(entry, std::chrono::steady_clock::now() < until));
    return jsonAnswer(nlohmann::json{{"path", folder.string()},
                                     {"parent", parentJson(roots, folder)},
                                     {"roots", rootsJson(roots)},
                                     {"entries", std::move(entries)},
                                     {"truncated", listing.truncated}});
}

Response previewFile(const ApiContext& context, const Request& request) {
    const engine::SourceRoots roots(context.engine.options().roots);
    const auto file = roots.resolve(request.query.requireText("path"));
    return jsonAnswer(context.engine.previewFile(file, nlohmann::json::object()));
}

} // namespace

void addFileRoutes(Router& router, const ApiContext& context) {
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/files",
         .handler = [&context](Request& request) { return listFiles(context, request); },
         .summary = "Lists a folder below the roots; with no path, the roots",
         .query = {{"path", "string", "absolute path of a folder"},
                   {"glob", "string", "file names must match it, e.g. *.nrrd"},
                   {"series", "boolean", "numbered files also as one entry with its files (default true)"}},
         .pool = Pool::Render,
         .answerDoc =
             "{path, parent, roots, entries: [{name, path, kind, bytes, format, preview, count?, files?}]}"});
    router.add({.method = "GET",
                .pattern = "/api/v1/files/preview",
                .handler = [&context](Request& request) { return previewFile(context, request); },
                .summary = "What a file holds, from its header",
                .query = {{"path", "string", "absolute path of a file", true}},
                .pool = Pool::Render,
                .answerDoc = "{format, dims, spacing, type, …}"});
}

} // namespace voxsheet::http
