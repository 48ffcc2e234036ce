#include "sheet/json_reader.h"

#include "base/errors.h"
#include "sheet/near_miss.h"
#include "sheet/utf8.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

void JsonReader::refuse(const std::string& why, const std::string& toDo) const {
    const std::string where = path_.empty() ? "document" : path_;
    throw InvalidInput(where, why, toDo).withField(where);
}

void JsonReader::requireObject() const {
    if (!value_->is_object()) refuse("is no JSON object", "use { }");
}

void JsonReader::allow(std::initializer_list<const char*> names) const {
    requireObject();
    for (const auto& [name, value] : value_->items()) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        const std::string nearest = nearestName(name, {names.begin(), names.end()});
        member(name, value)
            .refuse("is not known", nearest.empty() ? "remove it" : "did you mean \"" + nearest + "\"?");
    }
}

JsonReader JsonReader::member(const std::string& name, const nlohmann::json& value) const {
    std::string shown = name;
    if (name.size() > 60 || hasControlCharacter(name)) shown = inQuotes(name);
    return {value, path_.empty() ? shown : path_ + "." + shown, name};
}

std::optional<JsonReader> JsonReader::find(const char* name) const {
    requireObject();
    const auto found = value_->find(name);
    if (found == value_->end()) return std::nullopt;
    return member(name, *found);
}

JsonReader JsonReader::at(const char* name) const {
    if (auto found = find(name)) return *found;
    const std::string where = path_.empty() ? name : path_ + "." + name;
    throw InvalidInput(where, "is missing", "add it").withField(where);
}

std::vector<JsonReader> JsonReader::members() const {
    requireObject();
    std::vector<JsonReader> list;
    for (const auto& [name, value] : value_->items())
        list.push_back(member(name, value));
    return list;
}

std::vector<JsonReader> JsonReader::items() const {
    if (!value_->is_array()) refuse("is no list", "use [ ]");
    std::vector<JsonReader> list;
    for (std::size_t i = 0; i < value_->size(); ++i)
        list.push_back({(*value_)[i], path_ + "[" + std::to_string(i) + "]", std::to_string(i)});
    return list;
}

std::string JsonReader::text() const {
    if (!value_->is_string()) refuse("is no text", "put it in quotes");
    return value_->get<std::string>();
}

std::int64_t JsonReader::integer(std::int64_t min, std::int64_t max) const {
    const bool fits = value_->is_number_integer() &&
                      !(value_->is_number_unsigned() &&
                        value_->get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX));
    if (!fits || value_->get<std::int64_t>() < min || value_->get<std::int64_t>() > max)
        refuse("is no whole number from " + std::to_string(min) + " to " + std::to_string(max),
               "give such a number");
    return value_->get<std::int64_t>();
}

double JsonReader::number() const {
    if (!value_->is_number()) refuse("is no number", "give one");
    return value_->get<double>();
}

bool JsonReader::boolean() const {
    if (!value_->is_boolean()) refuse("is neither true nor false", "give one of them");
    return value_->get<bool>();
}

} // namespace voxsheet::sheet
