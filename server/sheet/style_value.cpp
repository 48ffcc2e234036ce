#include "sheet/style_value.h"

#include "sheet/number_text.h"

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

using nlohmann::json;

namespace {

struct ToJson {
    json operator()(const None&) const { return "none"; }
    json operator()(const Automatic&) const { return "auto"; }
    json operator()(double value) const { return value; }
    json operator()(std::int64_t value) const { return value; }
    json operator()(const std::string& value) const { return value; }
    json operator()(const Colour& value) const { return colourName(value); }
    json operator()(const glm::dvec3& value) const { return json::array({value.x, value.y, value.z}); }
    json operator()(const OpacityStops& stops) const {
        json list = json::array();
        for (const OpacityStop& stop : stops)
            list.push_back(json::array({stop.position, stop.opacity}));
        return list;
    }
    json operator()(const ColourStops& stops) const {
        json list = json::array();
        for (const ColourStop& stop : stops)
            list.push_back(json::array({stop.position, colourName(stop.colour)}));
        return list;
    }
    /// A column is a flat list, and so is a single row.
    json operator()(const NumberTable& table) const {
        json list = json::array();
        const bool column = !table.rows.empty() && table.rows.front().size() == 1;
        for (const auto& row : table.rows)
            list.push_back(column ? json(row.front()) : json(row));
        return list.size() == 1 && !column ? list.front() : list;
    }
    json operator()(const ColourList& colours) const {
        json list = json::array();
        for (const Colour& colour : colours)
            list.push_back(colourName(colour));
        return list;
    }
};

struct ToText {
    std::string operator()(const None&) const { return "none"; }
    std::string operator()(const Automatic&) const { return "auto"; }
    std::string operator()(double value) const { return numberText(value); }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(const Colour& value) const { return colourName(value); }
    std::string operator()(const glm::dvec3& v) const {
        return numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
    }
    std::string operator()(const OpacityStops& stops) const {
        std::string text;
        for (const OpacityStop& stop : stops)
            text += (text.empty() ? "" : ",") + numberText(stop.position) + ":" + numberText(stop.opacity);
        return text;
    }
    std::string operator()(const ColourStops& stops) const {
        std::string text;
        for (const ColourStop& stop : stops)
            text += (text.empty() ? "" : ",") + numberText(stop.position) + ":" + colourName(stop.colour);
        return text;
    }
    std::string operator()(const NumberTable& table) const {
        std::string text;
        for (const auto& row : table.rows) {
            if (!text.empty()) text += row.size() == 1 ? "," : ";";
            for (std::size_t i = 0; i < row.size(); ++i)
                text += (i == 0 ? "" : ",") + numberText(row[i]);
        }
        return text;
    }
    std::string operator()(const ColourList& colours) const {
        std::string text;
        for (const Colour& colour : colours)
            text += (text.empty() ? "" : ",") + colourName(colour);
        return text;
    }
};

} // namespace

json styleValueToJson(const StyleValue& value) { return std::visit(ToJson{}, value); }

json styleMapToJson(const StyleMap& style) {
    json object = json::object();
    for (const auto& [key, value] : style)
        object[key] = styleValueToJson(value);
    return object;
}

std::string styleValueText(const StyleValue& value) { return std::visit(ToText{}, value); }

} // namespace voxsheet::sheet
