#include "engine/colour_map.h"

#include "base/errors.h"
#include "engine/config_files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxsheet::engine {

namespace {

using nlohmann::json;

InvalidInput badMap(const std::string& name, const std::string& field, const std::string& why) {
    InvalidInput error("colour map '" + name + "'", why, "correct configs/colour_maps.json");
    error.withField(field);
    return error;
}

double numberIn(const json& value, const std::string& name, const std::string& field) {
    if (!value.is_number()) throw badMap(name, field, "'" + field + "' holds something that is not a number");
    return value.get<double>();
}

std::string textIn(const json& map, const std::string& field) {
    const auto found = map.find(field);
    if (found == map.end() || !found->is_string()) {
        throw badMap(map.value("name", "?"), field, "'" + field + "' is missing or not a text");
    }
    return found->get<std::string>();
}

std::vector<std::vector<double>> rowsIn(const json& map, const std::string& name, const std::string& field,
                                        std::size_t columns) {
    const auto found = map.find(field);
    if (found == map.end() || !found->is_array() || found->size() < 2) {
        throw badMap(name, field, "'" + field + "' must be a list of at least two stops");
    }
    std::vector<std::vector<double>> rows;
    for (const json& row : *found) {
        if (!row.is_array() || row.size() != columns) {
            throw badMap(name, field,
                         "a stop of '" + field + "' has not " + std::to_string(columns) + " numbers");
        }
        std::vector<double> numbers;
        for (const json& number : row)
            numbers.push_back(numberIn(number, name, field));
        if (!rows.empty() && numbers[0] < rows.back()[0]) {
            throw badMap(name, field, "the stops of '" + field + "' are not in order");
        }
        for (std::size_t i = 1; i < columns; ++i) {
            if (numbers[i] < 0 || numbers[i] > 1)
                throw badMap(name, field, "a colour or opacity lies outside 0 to 1");
        }
        rows.push_back(std::move(numbers));
    }
    return rows;
}

ColourMap mapFromJson(const json& document) {
    ColourMap map;
    map.name = textIn(document, "name");
    map.label = textIn(document, "label");
    map.source = textIn(document, "source");
    const std::string kind = textIn(document, "kind");
    if (kind == "sequential") {
        map.kind = ColourMapKind::Sequential;
    } else if (kind == "diverging") {
        map.kind = ColourMapKind::Diverging;
        map.pivot = numberIn(document.value("pivot", json(0.5)), map.name, "pivot");
    } else if (kind == "ct") {
        map.kind = ColourMapKind::Ct;
    } else {
        throw badMap(map.name, "kind", "'" + kind + "' is not a kind of map (sequential, diverging, ct)");
    }
    for (const auto& row : rowsIn(document, map.name, "stops", 4)) {
        map.stops.push_back({row[0], {row[1], row[2], row[3]}});
    }
    if (map.kind == ColourMapKind::Ct) {
        for (const auto& row : rowsIn(document, map.name, "opacity", 2))
            map.opacities.push_back({row[0], row[1]});
        const json window = document.value("window", json::array());
        if (!window.is_array() || window.size() != 2)
            throw badMap(map.name, "window", "'window' needs two numbers");
        map.window = {numberIn(window[0], map.name, "window"), numberIn(window[1], map.name, "window")};
        if (map.window.first >= map.window.second) throw badMap(map.name, "window", "'window' is empty");
    } else if (map.stops.front().position != 0.0 || map.stops.back().position != 1.0) {
        throw badMap(map.name, "stops", "the stops must run from 0 to 1");
    }
    return map;
}

glm::dvec3 colourAt(const std::vector<ColourPoint>& points, double position) {
    const auto after =
        std::upper_bound(points.begin(), points.end(), position,
                         [](double p, const ColourPoint& point) { return p < point.position; });
    if (after == points.begin()) return points.front().rgb;
    if (after == points.end()) return points.back().rgb;
    const ColourPoint& before = *(after - 1);
    const double w = (position - before.position) / (after->position - before.position);
    return before.rgb + w * (after->rgb - before.rgb);
}

double opacityAt(const std::vector<OpacityPoint>& points, double position) {
    const auto after =
        std::upper_bound(points.begin(), points.end(), position,
                         [](double p, const OpacityPoint& point) { return p < point.position; });
    if (after == points.begin()) return points.front().opacity;
    if (after == points.end()) return points.back().opacity;
    const OpacityPoint& before = *(after - 1);
    const double w = (position - before.position) / (after->position - before.position);
    return before.opacity + w * (after->opacity - before.opacity);
}

/// Values in HU that stand at positions 0 and 1.
std::pair<double, double> hounsfieldEnds(const ColourMap& map, double low, double high, bool anchored) {
    return anchored ? std::pair(low, high) : map.window;
}

} // namespace

ColourMapTable ColourMapTable::fromJson(std::string_view text) {
    const json document = json::parse(text, nullptr, false);
    if (document.is_discarded() || !document.is_object() || !document.contains("maps") ||
        !document["maps"].is_array() || document["maps"].empty()) {
        throw InvalidInput("the colour maps", "the document is not JSON with a list 'maps'",
                           "correct configs/colour_maps.json")
            .withField("maps");
    }
    ColourMapTable table;
    for (const json& entry : document["maps"]) {
        if (!entry.is_object()) throw badMap("?", "maps", "an entry is not an object");
        ColourMap map = mapFromJson(entry);
        if (table.find(map.name) != nullptr) throw badMap(map.name, "name", "the name is used twice");
        table.maps_.push_back(std::move(map));
    }
    return table;
}

const ColourMapTable& ColourMapTable::embedded() {
    static const ColourMapTable table = fromJson(configFile("colour_maps.json"));
    return table;
}

std::vector<std::string> ColourMapTable::names() const {
    std::vector<std::string> names;
    for (const ColourMap& map : maps_)
        names.push_back(map.name);
    return names;
}

const ColourMap* ColourMapTable::find(std::string_view name) const {
    for (const ColourMap& map : maps_) {
        if (map.name == name) return &map;
    }
    return nullptr;
}

std::vector<ColourPoint> coloursOverRange(const ColourMap& map, double low, double high, bool anchored) {
    if (map.kind != ColourMapKind::Ct) return map.stops;
    const auto [first, last] = hounsfieldEnds(map, low, high, anchored);
    std::vector<ColourPoint> points{{0.0, colourAt(map.stops, first)}};
    for (const ColourPoint& stop : map.stops) {
        const double position = (stop.position - first) / (last - first);
        if (position > 0 && position < 1) points.push_back({position, stop.rgb});
    }
    points.push_back({1.0, colourAt(map.stops, last)});
    return points;
}

std::vector<OpacityPoint> opacitiesOverRange(const ColourMap& map, double low, double high, bool anchored) {
    if (map.kind != ColourMapKind::Ct) return {};
    const auto [first, last] = hounsfieldEnds(map, low, high, anchored);
    std::vector<OpacityPoint> points{{0.0, opacityAt(map.opacities, first)}};
    for (const OpacityPoint& stop : map.opacities) {
        const double position = (stop.position - first) / (last - first);
        if (position > 0 && position < 1) points.push_back({position, stop.opacity});
    }
    points.push_back({1.0, opacityAt(map.opacities, last)});
    return points;
}

nlohmann::json describeColourMaps(const ColourMapTable& table) {
    json maps = json::array();
    for (const ColourMap& map : table.maps()) {
        const bool ct = map.kind == ColourMapKind::Ct;
        json entry = {{"name", map.name}, {"label", map.label}, {"source", map.source}};
        entry["kind"] = ct ? "ct" : map.kind == ColourMapKind::Diverging ? "diverging" : "sequential";
        if (map.kind == ColourMapKind::Diverging) entry["pivot"] = map.pivot;
        if (ct) entry["window"] = {map.window.first, map.window.second};
        json stops = json::array();
        for (const ColourPoint& stop : coloursOverRange(map, map.window.first, map.window.second, true)) {
            stops.push_back({stop.position, stop.rgb.x, stop.rgb.y, stop.rgb.z});
        }
        entry["stops"] = std::move(stops);
        maps.push_back(std::move(entry));
    }
    return {{"maps", std::move(maps)}};
}

} // namespace voxsheet::engine
