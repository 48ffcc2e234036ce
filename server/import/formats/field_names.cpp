#include "import/formats/field_names.h"

#include "base/errors.h"

#include <set>

namespace voxsheet::import {

std::vector<FieldMeta> makeFields(int count, ScalarType type, const std::vector<std::string>& names) {
    std::vector<FieldMeta> fields(static_cast<std::size_t>(count));
    for (std::size_t index = 0; index < fields.size(); ++index) {
        fields[index].storedType = type;
        if (names.size() == fields.size())
            fields[index].name = names[index];
        else
            fields[index].name = count == 1 ? "value" : "value " + std::to_string(index + 1);
    }
    return fields;
}

void checkFieldsAndSteps(const std::string& what, std::int64_t fields, std::int64_t steps) {
    constexpr std::int64_t mostFields = 4096;
    constexpr std::int64_t mostSteps = 100'000;
    if (fields > mostFields)
        throw LimitExceeded(what, "it has " + std::to_string(fields) + " fields, more than " +
                                      std::to_string(mostFields));
    if (steps > mostSteps)
        throw LimitExceeded(what, "it has " + std::to_string(steps) + " time steps, more than " +
                                      std::to_string(mostSteps));
}

std::vector<std::string> uniqueNames(std::vector<std::string> names) {
    std::set<std::string> used;
    for (auto& name : names) {
        if (name.empty()) name = "value";
        const auto base = name;
        for (int copy = 2; !used.insert(name).second; ++copy)
            name = base + " (" + std::to_string(copy) + ")";
    }
    return names;
}

} // namespace voxsheet::import
