#include "base/errors.h"
#include "engine/source_files.h"
#include "http/resource/api_context.h"
#include "http/resource/workbook_state.h"
#include "http/route/json_answer.h"
#include "http/route/problem.h"
#include "sheet/workbook_json.h"

#include <filesystem>

namespace voxsheet::http {

namespace {

constexpr std::uint64_t kDocumentBytes = std::uint64_t{16} << 20U;

std::string versionTag(std::uint64_t version) { return '"' + std::to_string(version) + '"'; }

Response getDocument(const ApiContext& context) {
    // Sources by absolute path: the document means the same wherever the workbook was saved last.
    const auto workbook = context.engine.snapshot();
    auto response = jsonAnswer(sheet::workbookToJson(*workbook));
    response.headers.add("ETag", versionTag(workbook->version));
    return response;
}

nlohmann::json undoState(const engine::Engine& engine) {
    return {{"version", engine.version()}, {"canUndo", engine.canUndo()}, {"canRedo", engine.canRedo()}};
}

/// What relative source paths of a document start from.
std::filesystem::path documentFolder(const engine::Engine& engine) {
    const auto& file = engine.options().workbookFile;
    return file.empty() ? std::filesystem::current_path() : std::filesystem::absolute(file).parent_path();
}

Response putDocument(const ApiContext& context, const Request& request) {
    const auto wanted = request.headers.find("If-Match");
    if (wanted && *wanted != "*" && *wanted != versionTag(context.engine.version()))
        throw HttpError(412, "the workbook was changed in between; fetch it again");
    context.engine.setWorkbookJson(jsonBody(request), documentFolder(context.engine));
    auto response = jsonAnswer(undoState(context.engine));
    response.headers.add("ETag", versionTag(context.engine.version()));
    return response;
}

/// A file that may be written: named .json, in an existing folder below a root, links followed.
std::filesystem::path saveTarget(const engine::Engine& engine, const std::string& text) {
    namespace fs = std::filesystem;
    fs::path file = text;
    if (file.is_relative()) file = documentFolder(engine) / file;
    const auto refuse = [&](const char* why) {
        return InvalidInput("file '" + text + "'", why, "name a .json file in a folder below a root")
            .withField("path");
    };
    if (file.extension() != ".json" || file.filename().string().starts_with('.'))
        throw refuse("it is not named *.json");
    std::error_code error;
    const auto folder = fs::canonical(file.parent_path(), error);
    if (error) throw refuse("its folder does not exist");
    file = folder / file.filename();
    const auto status = fs::symlink_status(file, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw refuse("something else than a file has this name");
    const engine::SourceRoots roots(engine.options().roots);
    for (const auto& root : roots.folders())
        if (engine::isBelow(file, root)) return file;
    throw refuse("it lies outside the folders that this server may use");
}

Response saveDocument(const ApiContext& context, const Request& request) {
    const auto body = request.body.empty() ? nlohmann::json::object() : jsonBody(request);
    allowMembers(body, {"path"});
    const auto text = stringOr(body, "path", "");
    const auto& own = context.engine.options().workbookFile;
    if (text.empty() && own.empty())
        throw InvalidInput("saving", "the workbook has no file yet", "give a path").withField("path");
    const auto file = text.empty() ? own : saveTarget(context.engine, text);
    context.engine.saveWorkbook(file);
    return jsonAnswer(nlohmann::json{{"path", file.string()}, {"version", context.engine.version()}});
}

StyleDetail styleDetail(const Request& request) {
    const auto word = request.query.text("styles").value_or("all");
    if (word == "all") return StyleDetail::All;
    if (word == "own") return StyleDetail::Own;
    throw InvalidInput("styles '" + word + "'", "there is no such detail", "choose all or own")
        .withField("styles");
}

} // namespace

void addWorkbookRoutes(Router& router, const ApiContext& context) {
    router.add({.method = "GET",
                .pattern = "/api/v1/workbook",
                .handler = [&context](Request&) { return getDocument(context); },
                .summary = "The whole document; its version is the ETag"});
    router.add({.method = "PUT",
                .pattern = "/api/v1/workbook",
                .handler = [&context](Request& request) { return putDocument(context, request); },
                .summary = "Replaces the whole document (one undo step); If-Match guards against lost edits",
                .bodyType = "application/json",
                .bodyDoc = "a workbook document, as GET gives it",
                .bodyBudgetBytes = kDocumentBytes,
                .pool = Pool::Render,
                .answerDoc = "{version, canUndo, canRedo}"});
    router.add({.method = "POST",
                .pattern = "/api/v1/workbook/save",
                .handler = [&context](Request& request) { return saveDocument(context, request); },
                .summary = "Writes the workbook to its file, or to another one below a root",
                .bodyType = "application/json",
                .bodyDoc = "{path?}",
                .bodyBudgetBytes = 1U << 16U,
                .pool = Pool::Render,
                .answerDoc = "{path, version}"});
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/state",
         .handler =
             [&context](Request& request) {
                 return jsonAnswer(workbookState(context.engine, styleDetail(request)));
             },
         .summary =
             "Everything a page needs after a change: document, cells, their states and resolved styles",
         .query = {{"styles", "string",
                    "all (every key of every cell), or own: a sheet's style once, and of a cell only what "
                    "column, row or cell set"}},
         .answerDoc = "{version, canUndo, canRedo, workbook, sheets}"});
    const auto step = [&](const char* pattern, const char* summary, bool (engine::Engine::*act)()) {
        router.add({.method = "POST",
                    .pattern = pattern,
                    .handler =
                        [&context, act](Request&) {
                            const bool changed = (context.engine.*act)();
                            auto answer = undoState(context.engine);
                            answer["changed"] = changed;
                            return jsonAnswer(answer);
                        },
                    .summary = summary,
                    .bodyBudgetBytes = 1024, // nothing is read from it; some clients send {}
                    .answerDoc = "{version, canUndo, canRedo, changed}"});
    };
    step("/api/v1/undo", "Takes back the last edit", &engine::Engine::undo);
    step("/api/v1/redo", "Brings back what undo took", &engine::Engine::redo);
    if (!context.settings.openDemo) return;
    router.add({.method = "POST",
                .pattern = "/api/v1/demo",
                .handler =
                    [&context](Request&) {
                        context.settings.openDemo();
                        return jsonAnswer(undoState(context.engine));
                    },
                .summary = "Writes the demo's files and opens its workbook (one undo step)",
                .bodyBudgetBytes = 1024, // nothing is read from it; some clients send {}
                .pool = Pool::Render,
                .answerDoc = "{version, canUndo, canRedo}"});
}

} // namespace voxsheet::http
