#include "sheet/style_keys.h"

#include "base/errors.h"
#include "sheet/near_miss.h"
#include "sheet/utf8.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

using nlohmann::json;

const char* keyTypeName(KeyType type) {
    switch (type) {
    case KeyType::Number:
        return "number";
    case KeyType::Integer:
        return "integer";
    case KeyType::Choice:
        return "choice";
    case KeyType::Colour:
        return "colour";
    case KeyType::Vector3:
        return "vector3";
    case KeyType::OpacityPoints:
        return "opacityPoints";
    case KeyType::ColourPoints:
        return "colourPoints";
    case KeyType::NumberRows:
        return "numberRows";
    case KeyType::Colours:
        return "colours";
    case KeyType::Text:
        return "text";
    case KeyType::FieldName:
        break;
    }
    return "fieldName";
}

KeyTable::KeyTable(std::vector<KeySpec> keys) : keys_(std::move(keys)) {
    for (const KeySpec& key : keys_)
        validateStyleValue(key, key.defaultValue);
}

const KeySpec* KeyTable::find(std::string_view name) const {
    const auto found =
        std::find_if(keys_.begin(), keys_.end(), [&](const KeySpec& key) { return key.name == name; });
    return found == keys_.end() ? nullptr : &*found;
}

const KeySpec& KeyTable::at(std::string_view name) const {
    if (const KeySpec* key = find(name)) return *key;
    std::vector<std::string> names;
    for (const KeySpec& key : keys_)
        names.push_back(key.name);
    const std::string nearest = nearestName(name, names);
    throw InvalidInput("style key " + inQuotes(name), "is not known",
                       nearest.empty() ? "see the key table for the names there are"
                                       : "did you mean \"" + nearest + "\"?")
        .withField(replaceInvalidUtf8(name.substr(0, 200)));
}

json describeKeys(const KeyTable& table) {
    json list = json::array();
    for (const KeySpec& key : table.keys()) {
        json item{{"name", key.name},
                  {"type", keyTypeName(key.type)},
                  {"group", key.group},
                  {"widget", key.widget},
                  {"doc", key.doc},
                  {"scope", key.scope == KeyScope::View ? "view" : "data"},
                  {"takesNone", key.takesNone},
                  {"takesAuto", key.takesAuto},
                  {"default", styleValueToJson(key.defaultValue)}};
        if (!key.unit.empty()) item["unit"] = key.unit;
        if (key.type == KeyType::Number || key.type == KeyType::Integer || key.type == KeyType::Vector3 ||
            key.type == KeyType::NumberRows) {
            item["min"] = key.min;
            item["max"] = key.max;
        }
        if (key.type == KeyType::NumberRows) {
            item["columns"] = key.columnNames.size();
            item["columnNames"] = key.columnNames;
            item["minRows"] = key.minRows;
            item["maxRows"] = key.maxRows;
        }
        if (!key.suggestions.empty()) item["suggestions"] = key.suggestions;
        if (!key.choices.empty()) item["choices"] = key.choices;
        if (!key.appliesWhen.key.empty())
            item["appliesWhen"] = {{"key", key.appliesWhen.key}, {"values", key.appliesWhen.values}};
        list.push_back(std::move(item));
    }
    return list;
}

} // namespace voxsheet::sheet
