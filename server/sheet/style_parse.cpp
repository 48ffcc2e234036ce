// Style values from JSON and from text. Reading makes the type, validateStyleValue checks the bounds: once,
// for both.
#include "base/errors.h"
#include "sheet/bounded_json.h"
#include "sheet/near_miss.h"
#include "sheet/number_text.h"
#include "sheet/style_keys.h"
#include "sheet/utf8.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

using nlohmann::json;

namespace {

constexpr std::size_t kMaxColours = 8;

/// "1 to 8 numbers", "up to 8 rows [x, y, z, position]".
std::string rowsExpectation(const KeySpec& key) {
    const std::string many = key.minRows == key.maxRows
                                 ? std::to_string(key.maxRows)
                                 : std::to_string(key.minRows) + " to " + std::to_string(key.maxRows);
    if (key.columnNames.size() == 1) return many + (key.maxRows == 1 ? " number" : " numbers");
    std::string names;
    for (const std::string& name : key.columnNames)
        names += (names.empty() ? "" : ", ") + name;
    return many + (key.maxRows == 1 ? " row [" : " rows [") + names + "]";
}

/// "a number from 0 to 1, or auto", for messages.
std::string expectation(const KeySpec& key) {
    const std::string bounds = "from " + numberText(key.min) + " to " + numberText(key.max);
    std::string text;
    switch (key.type) {
    case KeyType::Number:
        text = "a number " + bounds;
        break;
    case KeyType::Integer:
        text = "a whole number " + bounds;
        break;
    case KeyType::Choice:
        for (const std::string& word : key.choices)
            text += (text.empty() ? "one of " : ", ") + word;
        break;
    case KeyType::Colour:
        text = "#rrggbb, #rrggbbaa or transparent";
        break;
    case KeyType::Vector3:
        text = "three numbers [x, y, z], each " + bounds;
        break;
    case KeyType::OpacityPoints:
        text = "a list of [position, opacity], all from 0 to 1, positions not falling";
        break;
    case KeyType::ColourPoints:
        text = "a list of [position, \"#rrggbb\"], positions from 0 to 1 and not falling";
        break;
    case KeyType::FieldName:
        text = "a field's name, or its index from 0";
        break;
    case KeyType::NumberRows:
        text = rowsExpectation(key) + ", each " + bounds;
        break;
    case KeyType::Colours:
        text = "1 to " + std::to_string(kMaxColours) + " colours #rrggbb";
        break;
    case KeyType::Text:
        text = "a text of 1 to " + std::to_string(key.maxBytes) + " bytes";
        break;
    }
    if (key.takesNone) text += ", or none";
    if (key.takesAuto) text += ", or auto";
    if (!key.unit.empty() && key.type != KeyType::FieldName) text += " (" + key.unit + ")";
    return text;
}

[[noreturn]] void refuse(const KeySpec& key, const std::string& shown) {
    std::string toDo = "give " + expectation(key);
    if (key.type == KeyType::Choice) {
        const std::string nearest = nearestName(shown, key.choices);
        if (!nearest.empty()) toDo = "did you mean \"" + nearest + "\"? Give " + expectation(key);
    }
    throw InvalidInput(key.name, "the value " + inQuotes(shown) + " is not allowed", toDo)
        .withField(key.name);
}

std::string shownJson(const json& value) {
    return value.is_string() ? value.get<std::string>()
                             : value.dump(-1, ' ', false, json::error_handler_t::replace);
}

double finiteNumber(const KeySpec& key, const json& value) {
    if (!value.is_number()) refuse(key, shownJson(value));
    return value.get<double>();
}

glm::dvec3 vectorFromJson(const KeySpec& key, const json& value) {
    if (!value.is_array() || value.size() != 3) refuse(key, shownJson(value));
    return {finiteNumber(key, value[0]), finiteNumber(key, value[1]), finiteNumber(key, value[2])};
}

OpacityStops opacitiesFromJson(const KeySpec& key, const json& value) {
    if (!value.is_array()) refuse(key, shownJson(value));
    OpacityStops stops;
    for (const json& item : value) {
        if (!item.is_array() || item.size() != 2) refuse(key, shownJson(item));
        stops.push_back({finiteNumber(key, item[0]), finiteNumber(key, item[1])});
    }
    return stops;
}

ColourStops coloursFromJson(const KeySpec& key, const json& value) {
    if (!value.is_array()) refuse(key, shownJson(value));
    ColourStops stops;
    for (const json& item : value) {
        if (!item.is_array() || item.size() != 2 || !item[1].is_string()) refuse(key, shownJson(item));
        const auto colour = parseColour(item[1].get_ref<const std::string&>());
        if (!colour) refuse(key, shownJson(item));
        stops.push_back({finiteNumber(key, item[0]), *colour});
    }
    return stops;
}

std::vector<double> rowFromJson(const KeySpec& key, const json& value) {
    if (!value.is_array() || value.size() != key.columnNames.size()) refuse(key, shownJson(value));
    std::vector<double> row;
    for (const json& item : value)
        row.push_back(finiteNumber(key, item));
    return row;
}

NumberTable rowsFromJson(const KeySpec& key, const json& value) {
    NumberTable table;
    if (value.is_number()) {
        table.rows.push_back(rowFromJson(key, json::array({value})));
        return table;
    }
    if (!value.is_array()) refuse(key, shownJson(value));
    const bool flat = !value.empty() && value.front().is_number();
    if (flat && key.columnNames.size() > 1) {
        table.rows.push_back(rowFromJson(key, value));
        return table;
    }
    for (const json& item : value)
        table.rows.push_back(rowFromJson(key, flat ? json::array({item}) : item));
    return table;
}

ColourList colourListFromJson(const KeySpec& key, const json& value) {
    const json list = value.is_string() ? json::array({value}) : value;
    if (!list.is_array()) refuse(key, shownJson(value));
    ColourList colours;
    for (const json& item : list) {
        const auto colour = item.is_string() ? parseColour(item.get_ref<const std::string&>()) : std::nullopt;
        if (!colour) refuse(key, shownJson(item));
        colours.push_back(*colour);
    }
    return colours;
}

std::int64_t integerFromJson(const KeySpec& key, const json& value) {
    const double number = finiteNumber(key, value);
    // 3.0 is a whole number to most programs that write JSON.
    if (!(std::abs(number) < 9e15) || number != std::floor(number)) refuse(key, shownJson(value));
    return static_cast<std::int64_t>(number);
}

StyleValue readJson(const KeySpec& key, const json& value) {
    const bool word = value.is_string();
    if (word && key.takesNone && value == "none") return None{};
    if (word && key.takesAuto && value == "auto") return Automatic{};
    switch (key.type) {
    case KeyType::Number:
        return finiteNumber(key, value);
    case KeyType::Integer:
        return integerFromJson(key, value);
    case KeyType::Choice:
        if (!word) refuse(key, shownJson(value));
        return value.get<std::string>();
    case KeyType::Colour: {
        const auto colour = word ? parseColour(value.get_ref<const std::string&>()) : std::nullopt;
        if (!colour) refuse(key, shownJson(value));
        return *colour;
    }
    case KeyType::Vector3:
        return vectorFromJson(key, value);
    case KeyType::OpacityPoints:
        return opacitiesFromJson(key, value);
    case KeyType::ColourPoints:
        return coloursFromJson(key, value);
    case KeyType::NumberRows:
        return rowsFromJson(key, value);
    case KeyType::Colours:
        return colourListFromJson(key, value);
    case KeyType::Text:
        if (!word) refuse(key, shownJson(value));
        return value.get<std::string>();
    case KeyType::FieldName:
        break;
    }
    if (word) return value.get<std::string>();
    return integerFromJson(key, value);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t at = 0;;) {
        const std::size_t next = text.find(separator, at);
        parts.push_back(text.substr(at, next == std::string_view::npos ? next : next - at));
        if (next == std::string_view::npos) return parts;
        at = next + 1;
    }
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

json numberOrText(std::string_view text) {
    if (const auto number = parseNumber(text)) return *number;
    return std::string(text);
}

/// The JSON value that a text stands for; what it cannot be stays a string, which readJson then refuses.
json jsonFromText(const KeySpec& key, std::string_view text) {
    const bool isJson = !text.empty() && (text.front() == '[' || text.front() == '"');
    if (isJson && key.type != KeyType::FieldName && key.type != KeyType::Text)
        return parseBoundedJson(text, key.name, {65536, 8});
    switch (key.type) {
    case KeyType::Number:
    case KeyType::Integer:
        return numberOrText(text);
    case KeyType::Vector3: {
        if (split(text, ',').size() != 3) break;
        json list = json::array();
        for (const std::string_view part : split(text, ','))
            list.push_back(numberOrText(part));
        return list;
    }
    case KeyType::OpacityPoints:
    case KeyType::ColourPoints: {
        if (text.find(':') == std::string_view::npos) break;
        json list = json::array();
        for (const std::string_view part : split(text, ',')) {
            json pair = json::array();
            const auto halves = split(part, ':');
            for (std::size_t i = 0; i < halves.size(); ++i)
                pair.push_back(i == 1 && key.type == KeyType::ColourPoints ? json(std::string(halves[i]))
                                                                           : numberOrText(halves[i]));
            list.push_back(std::move(pair));
        }
        return list;
    }
    case KeyType::NumberRows: {
        if (text == "none" || text == "auto") break;
        json list = json::array();
        // In a column a comma is as good as a semicolon.
        for (const std::string_view row : split(text, key.columnNames.size() == 1 ? ',' : ';')) {
            json numbers = json::array();
            for (const std::string_view part : split(row, ','))
                numbers.push_back(numberOrText(trimmed(part)));
            list.push_back(std::move(numbers));
        }
        return list;
    }
    case KeyType::Colours: {
        if (text == "auto") break;
        json list = json::array();
        for (const std::string_view part : split(text, ','))
            list.push_back(std::string(trimmed(part)));
        return list;
    }
    case KeyType::FieldName:
        if (!text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos)
            return numberOrText(text);
        break;
    case KeyType::Choice:
    case KeyType::Colour:
    case KeyType::Text:
        break;
    }
    return std::string(text);
}

} // namespace

StyleValue parseStyleValue(const KeySpec& key, const json& value) {
    StyleValue parsed = readJson(key, value);
    validateStyleValue(key, parsed);
    return parsed;
}

StyleValue parseStyleText(const KeySpec& key, std::string_view text) {
    if (!isValidUtf8(text)) refuse(key, std::string(text));
    return parseStyleValue(key, jsonFromText(key, text));
}

namespace {

void requireObject(const json& object) {
    if (!object.is_object())
        throw InvalidInput("style", "is not a JSON object", "give a flat object of dotted keys")
            .withField("style");
}

} // namespace

StylePatch parseStylePatch(const KeyTable& table, const json& object) {
    requireObject(object);
    StylePatch patch;
    for (const auto& [name, value] : object.items()) {
        const KeySpec& key = table.at(name);
        patch[name] = value.is_null() ? std::nullopt : std::optional<StyleValue>(parseStyleValue(key, value));
    }
    return patch;
}

StyleMap parseStyleMap(const KeyTable& table, const json& object) {
    requireObject(object);
    StyleMap style;
    for (const auto& [name, value] : object.items())
        style[name] = parseStyleValue(table.at(name), value);
    return style;
}

std::pair<std::string, std::optional<StyleValue>> parseAssignment(const KeyTable& table,
                                                                  std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
        throw InvalidInput(inQuotes(text), "is no assignment",
                           "write KEY=VALUE, for example camera.azimuth=45");
    const KeySpec& key = table.at(text.substr(0, equals));
    const std::string_view value = text.substr(equals + 1);
    if (value.empty() || value == "null") return {key.name, std::nullopt};
    return {key.name, parseStyleText(key, value)};
}

namespace {

struct Validator {
    const KeySpec& key;

    [[nodiscard]] bool inBounds(double value) const { return value >= key.min && value <= key.max; }
    [[nodiscard]] static bool isFraction(double value) { return value >= 0.0 && value <= 1.0; }

    template <typename Stops>
    [[nodiscard]] static bool isOrdered(const Stops& stops) {
        if (stops.empty() || stops.size() > 256) return false;
        for (std::size_t i = 0; i < stops.size(); ++i) {
            if (!isFraction(stops[i].position)) return false;
            if (i > 0 && stops[i].position < stops[i - 1].position) return false;
        }
        return true;
    }

    bool operator()(const None&) const { return key.takesNone; }
    bool operator()(const Automatic&) const { return key.takesAuto; }
    bool operator()(double value) const { return key.type == KeyType::Number && inBounds(value); }
    bool operator()(std::int64_t value) const {
        if (key.type == KeyType::FieldName) return value >= 0 && value < 10000;
        return key.type == KeyType::Integer && inBounds(static_cast<double>(value));
    }
    bool operator()(const std::string& value) const {
        if (key.type == KeyType::FieldName)
            return !value.empty() && value.size() <= 200 && isValidUtf8(value) && !hasControlCharacter(value);
        if (key.type == KeyType::Text)
            return !value.empty() && value.size() <= key.maxBytes && isValidUtf8(value) &&
                   !hasControlCharacter(value);
        return key.type == KeyType::Choice &&
               std::find(key.choices.begin(), key.choices.end(), value) != key.choices.end();
    }
    bool operator()(const Colour&) const { return key.type == KeyType::Colour; }
    bool operator()(const glm::dvec3& v) const {
        return key.type == KeyType::Vector3 && inBounds(v.x) && inBounds(v.y) && inBounds(v.z);
    }
    bool operator()(const OpacityStops& stops) const {
        return key.type == KeyType::OpacityPoints && isOrdered(stops) &&
               std::all_of(stops.begin(), stops.end(),
                           [](const OpacityStop& s) { return isFraction(s.opacity); });
    }
    bool operator()(const ColourStops& stops) const {
        return key.type == KeyType::ColourPoints && isOrdered(stops) &&
               std::all_of(stops.begin(), stops.end(),
                           [](const ColourStop& s) { return s.colour.rgba[3] == 255; });
    }
    bool operator()(const NumberTable& table) const {
        if (key.type != KeyType::NumberRows || table.rows.size() < key.minRows ||
            table.rows.size() > key.maxRows)
            return false;
        return std::all_of(table.rows.begin(), table.rows.end(), [&](const std::vector<double>& row) {
            return row.size() == key.columnNames.size() &&
                   std::all_of(row.begin(), row.end(), [&](double value) { return inBounds(value); });
        });
    }
    bool operator()(const ColourList& colours) const {
        return key.type == KeyType::Colours && !colours.empty() && colours.size() <= kMaxColours &&
               std::all_of(colours.begin(), colours.end(), [](const Colour& c) { return c.rgba[3] == 255; });
    }
};

} // namespace

void validateStyleValue(const KeySpec& key, const StyleValue& value) {
    if (!std::visit(Validator{key}, value)) refuse(key, styleValueText(value));
}

} // namespace voxsheet::sheet
