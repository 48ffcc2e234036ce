#include "base/thread_count.h"
#include "http/resource/api_context.h"
#include "http/route/json_answer.h"
#include "sheet/style_keys.h"
#include "sheet/workbook.h"

namespace voxsheet::http {

namespace {

nlohmann::json deviceJson(const engine::Engine& engine, const std::vector<std::string>& devices) {
    const auto* device = engine.device();
    if (device == nullptr) return nullptr;
    return {{"renderer", device->renderer},
            {"vendor", device->vendor},
            {"version", device->version},
            {"platform", device->eglPlatform},
            {"reason", device->reason},
            {"software", device->software},
            {"robust", device->robust},
            {"max_texture_size_3d", device->maxTextureSize3d},
            {"workarounds", device->workarounds}, // of the driver, in force
            {"devices", devices}};
}

nlohmann::json pathsJson(const engine::Engine& engine) {
    auto paths = nlohmann::json::object();
    for (const auto& choice : engine.paths()) {
        auto candidates = nlohmann::json::array();
        for (const auto path : choice.candidates)
            candidates.push_back(pathName(path));
        nlohmann::json told{{"path", pathName(choice.path)},
                            {"why", reasonName(choice.reason)},
                            {"candidates", std::move(candidates)}};
        if (const auto& calibrated = choice.calibrated) {
            told["date"] = calibrated->date;
            told["ratio"] = calibrated->ratio; // time of the other path / time of this one
        }
        paths[techniqueName(choice.technique)] = std::move(told);
    }
    return paths;
}

nlohmann::json rootsJson(const engine::Engine& engine) {
    auto roots = nlohmann::json::array();
    for (const auto& root : engine.options().roots)
        roots.push_back(root.string());
    return roots;
}

Response info(const ApiContext& context, const std::vector<std::string>& devices) {
    const auto& options = context.engine.options();
    const auto residency = context.engine.residency();
    const auto* device = context.engine.device();
    const auto threads = threadCount();
    return jsonAnswer(nlohmann::json{{"name", "Voxsheet"},
                                     {"version", context.settings.version},
                                     {"device", deviceJson(context.engine, devices)},
                                     {"paths", pathsJson(context.engine)},
                                     {"budgets",
                                      {{"texture", residency.budgetBytes},
                                       {"texture_why", device != nullptr ? device->textureBudgetReason : ""},
                                       {"memory", options.memoryBudgetBytes},
                                       {"store", options.storeLimitBytes}}},
                                     {"threads", {{"count", threads.threads}, {"why", threads.reason}}},
                                     {"limits",
                                      {{"upload_bytes", context.settings.uploadLimitBytes},
                                       {"cells", sheet::kMaxCells},
                                       {"sheets", sheet::kMaxSheets},
                                       {"image_pixels_per_side", 8192}}},
                                     {"demo", static_cast<bool>(context.settings.openDemo)},
                                     {"roots", rootsJson(context.engine)}});
}

} // namespace

void addInfoRoutes(Router& router, const ApiContext& context) {
    // Asked for once: the driver takes milliseconds to open every device.
    auto devices = context.engine.device() != nullptr ? listRenderDevices() : std::vector<std::string>{};
    router.add(
        {.method = "GET",
         .pattern = "/api/v1",
         .handler = [&context, devices = std::move(devices)](Request&) { return info(context, devices); },
         .summary = "Version, device and why it was chosen, by which path each technique draws and why, "
                    "budgets, threads and why, limits, roots",
         .answerDoc = "{name, version, device, paths: {TECHNIQUE: {path: shader or simd, why: "
                      "rule, calibrated or forced, candidates, date and ratio where calibrated}}, budgets, "
                      "threads, limits, demo, roots}"});
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/keys",
         .handler =
             [&context](Request&) {
                 return jsonAnswer(nlohmann::json{{"keys", sheet::describeKeys(context.engine.keys())}});
             },
         .summary = "The table of style keys: type, unit, bounds, default, documentation",
         .answerDoc = "{keys: [{name, type, unit, min, max, choices, default, group, widget, doc}]}"});
    router.add({.method = "GET",
                .pattern = "/api/v1/presets",
                .handler =
                    [&context](Request&) {
                        return jsonAnswer(nlohmann::json{
                            {"presets", sheet::describePresets(context.engine.stylePresets())}});
                    },
                .summary = "Named looks: patches of style keys",
                .answerDoc = "{presets: [{name, label, doc, style: {KEY: value, or null to reset}}]}"});
    router.add({.method = "GET",
                .pattern = "/api/v1/colourmaps",
                .handler = [&context](Request&) { return jsonAnswer(context.engine.colourMaps()); },
                .summary = "The colour maps with their stops",
                .answerDoc = "{maps: [{name, label, kind, pivot, stops: [[position, r, g, b]]}]}"});
}

} // namespace voxsheet::http
