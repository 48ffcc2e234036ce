#include "base/errors.h"
#include "http/resource/api_context.h"
#include "http/resource/stream_update.h"
#include "http/route/json_answer.h"
#include "sheet/level_settings_json.h"
#include "stream/time_measurement.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::http {

namespace {

using nlohmann::json;

constexpr std::uint64_t kBodyBytes = 4096;

json numberOrNull(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json pointJson(const stream::TimingPoint& point) {
    json out{{"n", point.n},
             {"level", point.level},
             {"ms", point.ms.value},
             {"ms_low", point.ms.low},
             {"ms_high", point.ms.high},
             {"coverage", point.ms.coverage},
             {"frames", point.ms.count},
             {"partly", point.partly},
             {"resident_bytes", point.residentBytes},
             {"r_raw", point.rawRatio ? numberOrNull(*point.rawRatio) : json(nullptr)},
             {"r", nullptr},
             {"r_low", nullptr},
             {"r_high", nullptr}};
    if (point.ratio) {
        out["r"] = numberOrNull(point.ratio->value);
        out["r_low"] = numberOrNull(point.ratio->low);
        out["r_high"] = numberOrNull(point.ratio->high);
    }
    return out;
}

double numberMember(const json& body, const char* name, double fallback) {
    const auto found = body.find(name);
    if (found == body.end()) return fallback;
    if (!found->is_number())
        throw InvalidInput("member '" + std::string(name) + "'", "it must be a number").withField(name);
    return found->get<double>();
}

std::string sheetName(const ApiContext& context, const Request& request) {
    return sheet::sheetNamed(*context.engine.snapshot(), request.param("sheet")).name;
}

/// The settings in use, and whose they are.
json resolutionJson(const ApiContext& context, const std::string& sheet) {
    const auto workbook = context.engine.snapshot();
    json out = sheet::levelSettingsToJson(context.hub.levels(sheet).settings());
    out["policies"] = levelPolicyNames();
    out["from"] = sheet::sheetNamed(*workbook, sheet).levels ? "workbook" : "server";
    return out;
}

json cellsJson(const std::vector<stream::CellLevel>& cells) {
    json out = json::array();
    for (const stream::CellLevel& cell : cells)
        out.push_back({{"cell", sheet::addressName(cell.cell)},
                       {"level", cell.level},
                       {"footprint", cell.footprint},
                       {"pinned", cell.pinned}});
    return out;
}

json timingsJson(const ApiContext& context, const std::string& sheet) {
    const auto statuses = context.engine.cellStatuses(*context.engine.snapshot(), sheet);
    const auto ready = std::count_if(statuses.begin(), statuses.end(), [](const engine::CellStatus& status) {
        return status.state == engine::CellState::Ready;
    });
    const auto timings = context.hub.levels(sheet).timings();
    const auto residency = context.engine.residency();
    const auto host = context.engine.hostCache();
    const auto last = context.hub.lastFrame(sheet); // null before a page has drawn something
    json points = json::array();
    for (const stream::TimingPoint& point : timings.points)
        points.push_back(pointJson(point));
    const json now = timings.now ? pointJson(*timings.now) : json::object();
    const auto ofNow = [&](const char* name) { return now.value(name, json(nullptr)); };
    return {{"n", ready},
            {"shown", timings.n},
            {"t_n", ofNow("ms")},
            {"t_n_low", ofNow("ms_low")},
            {"t_n_high", ofNow("ms_high")},
            {"r_raw", ofNow("r_raw")},
            {"r", ofNow("r")},
            {"r_low", ofNow("r_low")},
            {"r_high", ofNow("r_high")},
            {"tile", {256, 256}},
            {"level", timings.level},
            {"levels", cellsJson(timings.cells)},
            {"policy", levelPolicyName(timings.settings.policy)},
            {"settings", resolutionJson(context, sheet)},
            {"reason", timings.reason},
            {"frame_ms", last ? json(last->frameMs) : json()},
            {"frame_tiles", last ? json(last->tiles) : json()},
            {"resident_bytes", residency.residentBytes},
            {"budget_bytes", residency.budgetBytes},
            {"visible_bytes", residency.visibleBytes},
            {"queued_bytes", residency.queuedBytes},
            {"uploaded_bytes", residency.uploadedBytes},
            {"uploads", residency.uploads},
            {"upload_ms", residency.uploadMs},
            {"read_ms", residency.readMs},
            {"evictions", residency.evictions},
            {"memory_budget_bytes", context.engine.options().memoryBudgetBytes},
            {"host_bytes", host.bytes},
            {"host_evictions", host.evictions},
            {"disk_bytes", host.diskBytes},
            {"disk_ms", host.diskMs},
            {"frames", context.hub.statistics().frames},
            {"points", points}};
}

/// What no page shows is measured as a sheet of equal tiles.
stream::ClientView viewToMeasure(const ApiContext& context, const std::string& name) {
    if (auto view = context.hub.newestView(name)) return *view;
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, name);
    return wholeSheetView(sheet, glm::dvec2(sheet.columns, sheet.rows) * 256.0);
}

Response measure(const ApiContext& context, const Request& request) {
    const auto sheet = sheetName(context, request);
    const auto body = request.body.empty() ? json::object() : jsonBody(request);
    allowMembers(body, {"repeats", "curve", "seconds"});
    stream::MeasureRequest wanted;
    if (body.contains("repeats")) wanted.repeats = static_cast<int>(integerIn(body, "repeats", 3, 25));
    wanted.curve = booleanOr(body, "curve", wanted.curve);
    wanted.seconds = numberMember(body, "seconds", wanted.seconds);
    const auto result =
        stream::measureTimeN(context.engine, context.hub.levels(sheet), sheet, viewToMeasure(context, sheet),
                             wanted, [gone = request.gone] { return gone->load(); });
    auto answer = timingsJson(context, sheet);
    answer["measured"] = {{"n", result.n},
                          {"frames", result.frames},
                          {"stopped_early", result.stoppedEarly},
                          {"warning", result.warning.empty() ? json(nullptr) : json(result.warning)}};
    return jsonAnswer(answer);
}

/// `{"policy": null}` asks for the server's own settings again.
bool asksForTheServers(const json& body) {
    const auto policy = body.find("policy");
    if (policy == body.end() || !policy->is_null()) return false;
    if (body.size() > 1)
        throw InvalidInput("policy", "null goes back to what the server was started with, limits included",
                           "leave the other members out")
            .withField("policy");
    return true;
}

Response patchSettings(const ApiContext& context, const Request& request) {
    const auto name = sheetName(context, request);
    const auto body = jsonBody(request);
    sheet::SetLevels command{name, std::nullopt};
    if (!asksForTheServers(body))
        command.levels =
            sheet::levelSettingsFromJson(sheet::JsonReader(body), context.hub.levels(name).settings());
    context.engine.apply(command);
    return jsonAnswer(resolutionJson(context, name));
}

} // namespace

void addTimingRoutes(Router& router, const ApiContext& context) {
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/sheets/{sheet}/timings",
         .handler =
             [&context](Request& request) {
                 return jsonAnswer(timingsJson(context, sheetName(context, request)));
             },
         .summary =
             "The dynamic-resolution state: N, T_N, R, levels of detail, resident bytes. T_N "
             "comes from redraws that happened anyway: of all cells on show, or (`partly`, with a wider "
             "interval, until a whole one comes) of some",
         .answerDoc =
             "{n, shown, t_n, t_n_low, t_n_high, r_raw, r, r_low, r_high, tile, level, levels: [{cell, "
             "level, footprint, pinned}], policy, settings, reason, frame_ms, resident_bytes, "
             "budget_bytes, …, points: [{n, level, ms, ms_low, ms_high, coverage, frames, partly, r_raw, r, "
             "r_low, r_high, resident_bytes}]}; times in ms with every tile of `tile` pixels"});
    router.add({.method = "POST",
                .pattern = "/api/v1/sheets/{sheet}/timings",
                .handler = [&context](Request& request) { return measure(context, request); },
                .summary = "Measures T_N now: draws the cells on show (without a page: all) some times over, "
                           "and the first few of them, behind everything that pages ask for",
                .bodyType = "application/json",
                .bodyDoc = "{repeats?: 3 to 25, curve?: true, seconds?: 30}",
                .bodyBudgetBytes = kBodyBytes,
                .pool = Pool::Render,
                .answerDoc = "as GET, and measured: {n, frames, stopped_early, warning}"});
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/sheets/{sheet}/resolution",
         .handler =
             [&context](Request& request) {
                 return jsonAnswer(resolutionJson(context, sheetName(context, request)));
             },
         .summary = "How the levels of detail of this sheet's cells are chosen",
         .answerDoc =
             "{policy, frame_ms, frames_per_second, datasets, bytes, up_fraction, policies: [name], from: "
             "\"workbook\" | \"server\" (what it was started with)}"});
    router.add(
        {.method = "PATCH",
         .pattern = "/api/v1/sheets/{sheet}/resolution",
         .handler = [&context](Request& request) { return patchSettings(context, request); },
         .summary =
             "Chooses the policy of levels of detail, and its limits: a part of the workbook, and one undo "
             "step. {policy: null} goes back to what the server was started with",
         .bodyType = "application/json",
         .bodyDoc = "{policy?: \"off\" | \"focus\" | \"slope\" | \"slope-first\" | \"time\" | \"rate\" | "
                    "\"count\" | \"bytes\" | null, frame_ms?, frames_per_second?, datasets?, bytes?, "
                    "up_fraction?}",
         .bodyBudgetBytes = kBodyBytes,
         .answerDoc = "as GET"});
}

} // namespace voxsheet::http
