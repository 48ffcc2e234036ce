#include "base/errors.h"
#include "http/resource/api_context.h"
#include "http/resource/style_text.h"
#include "http/route/json_answer.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::http {

namespace {

constexpr double kMaxCoordinate = 1e12;

/// NaN and infinity have no form in JSON.
nlohmann::json numberOrNull(const std::optional<double>& value) {
    if (!value || !std::isfinite(*value)) return nullptr;
    return *value;
}

nlohmann::json pointJson(const glm::dvec3& point) {
    return nlohmann::json::array({point.x, point.y, point.z});
}

nlohmann::json labelJson(const std::string& label) {
    return label.empty() ? nlohmann::json(nullptr) : nlohmann::json(label);
}

nlohmann::json layersJson(const std::vector<engine::LayerValue>& layers) {
    auto list = nlohmann::json::array();
    for (const auto& layer : layers)
        list.push_back({{"name", layer.name},
                        {"value", numberOrNull(layer.value)},
                        {"interpolated", numberOrNull(layer.interpolated)},
                        {"label", labelJson(layer.label)},
                        {"unit", layer.unit},
                        {"note", layer.note}});
    return list;
}

nlohmann::json valueJson(const engine::ProbeValue& probe) {
    return {{"cell", sheet::addressName(probe.cell)},
            {"value", numberOrNull(probe.value)},
            {"interpolated", numberOrNull(probe.interpolated)},
            {"index", {probe.index.x, probe.index.y, probe.index.z}},
            {"label", labelJson(probe.label)},
            {"atom", labelJson(probe.atom)},
            {"unit", probe.unit},
            {"note", probe.note},
            {"hit", probe.hit.empty() ? nlohmann::json(nullptr) : nlohmann::json(probe.hit)},
            {"isovalue", numberOrNull(probe.isovalue)},
            {"layers", layersJson(probe.layers)}};
}

Response probeAnswer(const nlohmann::json& world, const std::vector<engine::ProbeValue>& probes) {
    auto values = nlohmann::json::array();
    for (const auto& probe : probes)
        values.push_back(valueJson(probe));
    return jsonAnswer(nlohmann::json{{"world", world}, {"values", std::move(values)}});
}

/// The view of the page that asks, if it says which stream is its own; style keys of the query stand above
/// it.
engine::View viewOf(const ApiContext& context, const Request& request,
                    std::initializer_list<const char*> others) {
    engine::View view;
    if (const auto id = request.query.text("stream"); id && !id->empty())
        view = context.hub.view(*id).overrides;
    for (const auto& [key, value] : styleFromQuery(request.query, context.engine.keys(), others))
        view.request[key] = value;
    return view;
}

Response probe(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto sheet = sheet::sheetNamed(*workbook, request.param("sheet")).name;
    const auto& query = request.query;
    if (!query.has("cell")) {
        const glm::dvec3 world{query.requireNumber("x", -kMaxCoordinate, kMaxCoordinate),
                               query.requireNumber("y", -kMaxCoordinate, kMaxCoordinate),
                               query.requireNumber("z", -kMaxCoordinate, kMaxCoordinate)};
        return probeAnswer(pointJson(world), context.engine.probeWorld(sheet, world));
    }
    const auto cell = sheet::parseAddress(query.requireText("cell"));
    static_cast<void>(query.requireText("width"));
    static_cast<void>(query.requireText("height"));
    const glm::ivec2 size{*query.integer("width", 1, 8192), *query.integer("height", 1, 8192)};
    const glm::dvec2 pixel{query.requireNumber("px", 0.0, size.x), query.requireNumber("py", 0.0, size.y)};
    const auto view =
        viewOf(context, request, {"cell", "px", "py", "width", "height", "stream", "x", "y", "z"});
    const auto probes = context.engine.probePixel(sheet, cell, view, pixel, size);
    const auto own = std::find_if(probes.begin(), probes.end(),
                                  [&](const engine::ProbeValue& entry) { return entry.cell == cell; });
    return probeAnswer(own != probes.end() ? pointJson(own->world) : nlohmann::json(nullptr), probes);
}

Response colourBar(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto sheet = sheet::sheetNamed(*workbook, request.param("sheet")).name;
    const auto cell = sheet::parseAddress(request.param("cell"));
    return jsonAnswer(context.engine.colourBar(sheet, cell, viewOf(context, request, {"stream"})));
}

engine::RangeOver rangeOver(const std::string& word) {
    if (word == "data") return engine::RangeOver::Data;
    if (word == "time") return engine::RangeOver::Time;
    if (word == "visible") return engine::RangeOver::Visible;
    throw InvalidInput("over '" + word + "'", "there is no such range", "choose data, time or visible")
        .withField("over");
}

Response valueRange(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto sheet = sheet::sheetNamed(*workbook, request.param("sheet")).name;
    const auto cell = sheet::parseAddress(request.param("cell"));
    const auto& query = request.query;
    const std::string over = query.text("over").value_or("data");
    const glm::ivec2 size{query.integer("width", 1, 8192).value_or(512),
                          query.integer("height", 1, 8192).value_or(512)};
    const auto view = viewOf(context, request, {"over", "width", "height", "stream"});
    const auto range = context.engine.valueRange(sheet, cell, view, rangeOver(over), size);
    return jsonAnswer(nlohmann::json{{"over", over},
                                     {"min", range ? nlohmann::json(range->min) : nlohmann::json(nullptr)},
                                     {"max", range ? nlohmann::json(range->max) : nlohmann::json(nullptr)}});
}

} // namespace

void addProbeRoutes(Router& router, const ApiContext& context) {
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/sheets/{sheet}/probe",
         .handler = [&context](Request& request) { return probe(context, request); },
         .summary =
             "The value in every cell at a world point, or at what lies under a pixel of one cell's picture",
         .query = {{"x", "number", "world coordinate"},
                   {"y", "number", "world coordinate"},
                   {"z", "number", "world coordinate"},
                   {"cell", "string", "e.g. A1, with px, py, width and height instead of x, y, z"},
                   {"px", "number", "pixels from the left edge"},
                   {"py", "number", "pixels from the top edge"},
                   {"width", "integer", "of the picture"},
                   {"height", "integer", "of the picture"},
                   {"stream", "string", "use the view of this stream's page"}},
         .anyStyleKey = true,
         .pool = Pool::Render,
         .answerDoc =
             "{world, values: [{cell, value, interpolated, index, label, atom, unit, note, hit, isovalue, "
             "layers: [{name, "
             "value, interpolated, label, unit, note}]}]}; label: what a label map calls the value, "
             "else null; "
             "layers: of the fused view, or the overlay; hit: of "
             "the cell whose picture was probed, \"isosurface\", \"face\", \"atom\" (whose element is "
             "`atom`), \"sample\" or \"middle\" "
             "(nothing opaque enough), else null"});
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/sheets/{sheet}/cells/{cell}/range",
         .handler = [&context](Request& request) { return valueRange(context, request); },
         .summary = "Smallest and largest value of what a cell shows",
         .query = {{"over", "string",
                    "data (the shown time step), time (all steps), or visible (samples within the picture's "
                    "edges that clipping keeps; on a plane those next to it)"},
                   {"width", "integer", "of the picture, for visible; 512"},
                   {"height", "integer", "of the picture, for visible; 512"},
                   {"stream", "string", "use the view of this stream's page"}},
         .anyStyleKey = true,
         .pool = Pool::Render,
         .answerDoc = "{over, min, max}; null where no value is finite"});
    router.add({.method = "GET",
                .pattern = "/api/v1/sheets/{sheet}/cells/{cell}/colourbar",
                .handler = [&context](Request& request) { return colourBar(context, request); },
                .summary = "The transfer function of a cell as drawn, for a colour bar",
                .query = {{"stream", "string", "use the view of this stream's page"}},
                .anyStyleKey = true,
                .answerDoc =
                    "{stops, low, high, scale, unit, quantity, shared, ticks, isovalues: [{value, position, "
                    "colour, opacity}], colouredBy, labels: [{value, name, colour, hidden}], layers}"});
}

} // namespace voxsheet::http
