#include "base/errors.h"
#include "engine/dataset_json.h"
#include "http/resource/api_context.h"
#include "http/resource/upload.h"
#include "http/route/json_answer.h"

#include <algorithm>
#include <charconv>

namespace voxsheet::http {

namespace fs = std::filesystem;

namespace {

const char* stateWord(engine::DatasetState state) {
    switch (state) {
    case engine::DatasetState::Queued:
        return "queued";
    case engine::DatasetState::Importing:
        return "importing";
    case engine::DatasetState::Ready:
        return "ready";
    case engine::DatasetState::Failed:
        break;
    }
    return "failed";
}

nlohmann::json datasetJson(const engine::DatasetInfo& info) {
    auto out = info.meta ? engine::describeDataset(*info.meta) : nlohmann::json::object();
    auto files = nlohmann::json::array();
    std::uint64_t bytes = 0;
    for (const auto& file : info.files) {
        std::error_code error;
        const auto size = fs::file_size(file, error);
        if (!error) bytes += size;
        files.push_back(file.string());
    }
    out["name"] = info.name;
    out["state"] = stateWord(info.state);
    out["progress"] = info.progress;
    out["error"] = nullptr;
    if (info.failure)
        out["error"] = {{"kind", errorKindName(info.failure->kind)}, {"message", info.failure->message}};
    out["files"] = std::move(files);
    out["bytes"] = bytes;
    out["job"] = info.job;
    return out;
}

Response listDatasets(const ApiContext& context) {
    auto list = nlohmann::json::array();
    for (const auto& info : context.engine.datasets())
        list.push_back(datasetJson(info));
    return jsonAnswer(nlohmann::json{{"datasets", std::move(list)}});
}

std::vector<fs::path> filesOf(const nlohmann::json& body) {
    const auto found = body.find("files");
    if (found == body.end() || !found->is_array() || found->empty())
        throw InvalidInput("member 'files'", "it must be a list with at least one path").withField("files");
    std::vector<fs::path> files;
    for (const auto& item : *found) {
        if (!item.is_string() || item.get_ref<const std::string&>().empty())
            throw InvalidInput("member 'files'", "it must hold paths").withField("files");
        files.emplace_back(item.get<std::string>());
    }
    return files;
}

nlohmann::json optionsOf(const nlohmann::json& body) {
    const auto found = body.find("options");
    if (found == body.end() || found->is_null()) return nlohmann::json::object();
    if (!found->is_object())
        throw InvalidInput("member 'options'", "it must be an object").withField("options");
    return *found;
}

/// A relative path starts from the first root.
fs::path absolute(const ApiContext& context, const fs::path& file) {
    const auto& roots = context.engine.options().roots;
    return file.is_absolute() || roots.empty() ? file : roots.front() / file;
}

/// `series`: false (a dataset per file), "stack" or "steps" (one dataset of all), true (one, guessed by its
/// first).
bool takeSeries(const nlohmann::json& body, nlohmann::json& options) {
    const auto found = body.find("series");
    if (found == body.end() || found->is_null() || *found == false) return false;
    if (*found == "stack" || *found == "steps")
        options["series"] = *found;
    else if (*found != true)
        throw InvalidInput("member 'series'", "it must be true, false, \"stack\" or \"steps\"")
            .withField("series");
    return true;
}

Response importFiles(const ApiContext& context, const Request& request) {
    const auto body = jsonBody(request);
    allowMembers(body, {"files", "name", "options", "series", "place", "cell"});
    engine::ImportRequest common;
    common.name = stringOr(body, "name", "");
    common.options = optionsOf(body);
    common.place = booleanOr(body, "place", true);
    if (body.contains("cell")) common.cell = sheet::parseAddress(requireString(body, "cell"));
    std::vector<engine::ImportRequest> requests;
    const auto files = filesOf(body);
    const bool together = takeSeries(body, common.options);
    for (const auto& file : files) {
        if (requests.empty() || !together) requests.push_back(common);
        requests.back().files.push_back(absolute(context, file));
    }
    if (requests.size() > 1 && !common.name.empty())
        throw InvalidInput("member 'name'", "one name cannot serve several datasets",
                           "leave it out, or set series to true to make them one dataset")
            .withField("name");
    if (requests.size() > 1 && common.cell)
        throw InvalidInput("member 'cell'", "one cell cannot hold several datasets").withField("cell");
    const auto names = context.engine.importDatasets(requests);
    auto jobs = nlohmann::json::array();
    for (const auto& info : context.engine.datasets())
        if (std::find(names.begin(), names.end(), info.name) != names.end()) jobs.push_back(info.job);
    return jsonAnswer(nlohmann::json{{"datasets", names}, {"jobs", std::move(jobs)}}, 202);
}

Response uploadFile(const ApiContext& context, Request& request) {
    const auto fileName = request.query.text("filename").value_or(request.param("name"));
    const auto type = request.headers.find("Content-Type").value_or("");
    if (type.starts_with("multipart/"))
        throw InvalidInput("upload", "the body must be the file itself, not a form",
                           "send the bytes with Content-Type: application/octet-stream");
    const auto received = receiveFile(*request.bodyReader, context.engine.options().uploadDir);
    const auto name = context.engine.importUpload(request.param("name"), received.path(), fileName);
    return jsonAnswer(nlohmann::json{{"name", name}, {"job", context.engine.dataset(name).job}}, 202);
}

int fieldIndex(const DatasetMeta& meta, const std::string& text) {
    int index = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), index);
    if (result.ec == std::errc{} && result.ptr == text.data() + text.size()) return index;
    for (std::size_t i = 0; i < meta.fields.size(); ++i)
        if (meta.fields[i].name == text) return static_cast<int>(i);
    throw NotFound("field '" + text + "'", "the dataset has no field of this name").withField("field");
}

Response histogram(const ApiContext& context, const Request& request) {
    const auto info = context.engine.dataset(request.param("name"));
    if (!info.meta)
        throw Conflict("dataset '" + info.name + "'",
                       info.failure ? info.failure->message : "it is still being imported");
    const auto field = request.query.text("field");
    const auto step = request.query.integer("step", 0, 1'000'000).value_or(0);
    return jsonAnswer(engine::describeHistogram(
        *info.meta, field && !field->empty() ? fieldIndex(*info.meta, *field) : 0, static_cast<int>(step)));
}

void addImportRoutes(Router& router, const ApiContext& context) {
    router.add(
        {.method = "POST",
         .pattern = "/api/v1/datasets",
         .handler = [&context](Request& request) { return importFiles(context, request); },
         .summary =
             "Imports files below a root in the background: a dataset per file, or one from all of them with "
             "series \"stack\" (slices of a volume), \"steps\" (of time) or true (as the first file "
             "suggests)",
         .bodyType = "application/json",
         .bodyDoc = "{files: [PATH], name?, options?, series?, place?, cell?}",
         .bodyBudgetBytes = std::uint64_t{1} << 20U,
         .pool = Pool::Render,
         .successStatus = 202,
         .answerDoc = "{datasets: [names], jobs: [ids]}"});
    router.add(
        {.method = "PUT",
         .pattern = "/api/v1/datasets/{name}/content",
         .handler = [&context](Request& request) { return uploadFile(context, request); },
         .summary = "Uploads a file and imports it",
         .query = {{"filename", "string", "the file's own name; its ending helps to recognise the format"}},
         .bodyType = "application/octet-stream",
         .bodyDoc = "the file",
         .bodyBudgetBytes = context.settings.uploadLimitBytes,
         .streamsBody = true,
         .pool = Pool::Stream,
         .successStatus = 202,
         .answerDoc = "{name, job}"});
    router.add({.method = "POST",
                .pattern = "/api/v1/datasets/{name}/cancel",
                .handler =
                    [&context](Request& request) {
                        context.engine.cancelImport(request.param("name"));
                        return noContent();
                    },
                .summary = "Stops an import",
                .bodyBudgetBytes = 1024,
                .successStatus = 204});
}

} // namespace

void addDatasetRoutes(Router& router, const ApiContext& context) {
    router.add({.method = "GET",
                .pattern = "/api/v1/datasets",
                .handler = [&context](Request&) { return listDatasets(context); },
                .summary = "All datasets with state, progress and metadata",
                .answerDoc = "{datasets: [{name, state, progress, error, files, dims, spacing, …}]}"});
    addImportRoutes(router, context);
    router.add({.method = "GET",
                .pattern = "/api/v1/datasets/{name}",
                .handler =
                    [&context](Request& request) {
                        return jsonAnswer(datasetJson(context.engine.dataset(request.param("name"))));
                    },
                .summary = "One dataset"});
    router.add({.method = "DELETE",
                .pattern = "/api/v1/datasets/{name}",
                .handler =
                    [&context](Request& request) {
                        context.engine.removeDataset(request.param("name"));
                        return noContent();
                    },
                .summary = "Removes a dataset from the workbook (its files stay)",
                .bodyBudgetBytes = 1024,
                .successStatus = 204});
    router.add({.method = "GET",
                .pattern = "/api/v1/datasets/{name}/histogram",
                .handler = [&context](Request& request) { return histogram(context, request); },
                .summary = "Histogram and statistics of one field and step",
                .query = {{"field", "string", "name or index; default: the first"},
                          {"step", "integer", "time step, from 0"}},
                .answerDoc = "{low, high, counts, mean, min, max, stddev, nan}"});
}

} // namespace voxsheet::http
