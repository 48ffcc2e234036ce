#include "import/formats/raw_sidecar.h"

#include "base/errors.h"
#include "import/formats/geometry.h"
#include "import/formats/number_text.h"

#include <array>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

namespace voxsheet::import {

namespace {

using nlohmann::json;

json parseJson(const InputFile& file) {
    constexpr std::uint64_t mostBytes = 1U << 20;
    constexpr int deepest = 8;
    if (file.bytes() > mostBytes)
        throw InvalidInput(file.name(), "as a JSON sidecar it is too large (more than 1 MiB)");
    bool tooDeep = false;
    const auto limitDepth = [&](int depth, json::parse_event_t, json&) {
        tooDeep = tooDeep || depth > deepest;
        return depth <= deepest;
    };
    auto document = json::parse(file.textAt(0, mostBytes), limitDepth, /*allow_exceptions=*/false);
    if (document.is_discarded() || tooDeep || !document.is_object())
        throw InvalidInput(file.name(), "as a JSON sidecar it is not valid", "it must be one JSON object");
    return document;
}

ScalarType typeByWord(const std::string& word, bool& known) {
    static const std::map<std::string, ScalarType> words{
        {"uint8", ScalarType::U8},    {"int8", ScalarType::I8},    {"uint16", ScalarType::U16},
        {"int16", ScalarType::I16},   {"uint32", ScalarType::U32}, {"int32", ScalarType::I32},
        {"uint64", ScalarType::U64},  {"int64", ScalarType::I64},  {"float32", ScalarType::F32},
        {"float64", ScalarType::F64}, {"float", ScalarType::F32},  {"double", ScalarType::F64}};
    known = true;
    if (const auto type = scalarFromName(word)) return *type;
    if (const auto it = words.find(word); it != words.end()) return it->second;
    known = false;
    return ScalarType::U8;
}

class MemberReader {
public:
    MemberReader(const InputFile& file, const json& object) : name_(file.name()), object_(object) {}

    [[noreturn]] void fail(const char* member, const char* why) const {
        throw InvalidInput(name_, std::string("the member '") + member + "' " + why).withField(member);
    }
    [[nodiscard]] bool has(const char* member) const { return object_.contains(member); }

    [[nodiscard]] std::vector<double> numbers(const char* member, std::size_t count) const {
        const auto& value = object_.at(member);
        const bool list = value.is_array() && (count == 0 || value.size() == count);
        if (!list) fail(member, ("must be a list of " + std::to_string(count) + " numbers").c_str());
        std::vector<double> result;
        for (const auto& entry : value) {
            if (!entry.is_number() || !std::isfinite(entry.get<double>()))
                fail(member, "must hold finite numbers only");
            result.push_back(entry.get<double>());
        }
        return result;
    }
    [[nodiscard]] std::int64_t integer(const char* member, std::int64_t missing) const {
        return has(member) ? wholeNumber(member, object_.at(member)) : missing;
    }
    [[nodiscard]] std::vector<std::int64_t> integers(const char* member, std::size_t count) const {
        const auto& value = object_.at(member);
        if (!value.is_array() || value.size() != count) fail(member, "must be a list of three whole numbers");
        std::vector<std::int64_t> result;
        for (const auto& entry : value)
            result.push_back(wholeNumber(member, entry));
        return result;
    }
    [[nodiscard]] double number(const char* member, double missing) const {
        if (!has(member)) return missing;
        const auto& value = object_.at(member);
        if (!value.is_number() || !std::isfinite(value.get<double>()))
            fail(member, "must be a finite number");
        return value.get<double>();
    }
    [[nodiscard]] std::string word(const char* member, const std::string& missing) const {
        if (!has(member)) return missing;
        const auto& value = object_.at(member);
        if (!value.is_string()) fail(member, "must be a text");
        return value.get<std::string>();
    }
    [[nodiscard]] bool truth(const char* member, bool missing) const {
        if (!has(member)) return missing;
        const auto& value = object_.at(member);
        if (!value.is_boolean()) fail(member, "must be true or false");
        return value.get<bool>();
    }
    [[nodiscard]] const json& object() const { return object_; }

private:
    [[nodiscard]] std::int64_t wholeNumber(const char* member, const json& value) const {
        const bool tooLarge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
        if (!value.is_number_integer() || tooLarge) fail(member, "must be a whole number");
        return value.get<std::int64_t>();
    }

    std::string name_;
    const json& object_;
};

void readPlacement(const InputFile& file, const MemberReader& members, RawDescription& description) {
    const auto spacing =
        members.has("spacing") ? members.numbers("spacing", 3) : std::vector<double>{1, 1, 1};
    checkSpacing(file.name(), spacing);
    const auto origin = members.has("origin") ? members.numbers("origin", 3) : std::vector<double>{0, 0, 0};
    const auto direction = members.has("direction") ? members.numbers("direction", 9)
                                                    : std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1};
    AxisColumns columns{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns[axis] = spacing[axis] * glm::dvec3(direction[axis], direction[3 + axis], direction[6 + axis]);
    description.worldFromIndex = affine(columns, {origin[0], origin[1], origin[2]});
    if (members.has("periodic")) {
        const auto& periodic = members.object().at("periodic");
        if (!periodic.is_array() || periodic.size() != 3)
            members.fail("periodic", "must be a list of three of true or false");
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const auto& entry = periodic[static_cast<std::size_t>(axis)];
            if (!entry.is_boolean()) members.fail("periodic", "must be a list of three of true or false");
            description.periodic[axis] = entry.get<bool>();
        }
    }
    const auto centring = members.word("centring", "point");
    if (centring != "point" && centring != "cell") members.fail("centring", "must be \"point\" or \"cell\"");
    description.centring = centring == "cell" ? Centring::Cell : Centring::Point;
}

void readFieldNames(const MemberReader& members, RawDescription& description) {
    if (!members.has("fields")) return;
    const auto& names = members.object().at("fields");
    if (!names.is_array()) members.fail("fields", "must be a list of names");
    for (const auto& name : names) {
        if (!name.is_string()) members.fail("fields", "must be a list of names");
        for (const auto& before : description.fields)
            if (before == name.get<std::string>()) members.fail("fields", "holds a name twice");
        description.fields.push_back(name.get<std::string>());
    }
    if (static_cast<std::int64_t>(description.fields.size()) != description.components)
        members.fail("fields", "must have one name per component");
}

std::vector<std::string> unknownMembers(const json& object) {
    static constexpr std::array<const char*, 18> known{
        "dims",     "type",   "file",       "endian",      "skip",         "components",
        "steps",    "fields", "times",      "spacing",     "direction",    "periodic",
        "centring", "units",  "anatomical", "value_scale", "value_offset", "origin"};
    std::vector<std::string> unknown;
    for (const auto& [key, value] : object.items()) {
        bool found = false;
        for (const auto* name : known)
            found = found || key == name;
        if (!found) unknown.push_back(key);
    }
    return unknown;
}

} // namespace

RawDescription parseRawSidecar(const InputFile& file) {
    const auto object = parseJson(file);
    const MemberReader members(file, object);
    RawDescription description;
    for (const auto* needed : {"dims", "type"})
        if (!members.has(needed)) members.fail(needed, "is missing");
    description.dims = members.integers("dims", 3);
    bool known = false;
    description.type = typeByWord(lowerCase(members.word("type", "")), known);
    if (!known) members.fail("type", "must be one of u8 i8 u16 i16 u32 i32 u64 i64 f32 f64");
    const auto endian = members.word("endian", "little");
    if (endian != "little" && endian != "big") members.fail("endian", "must be \"little\" or \"big\"");
    description.bigEndian = endian == "big";
    description.file = members.word("file", "");
    description.skip = members.integer("skip", 0);
    if (description.skip < 0) members.fail("skip", "must not be negative");
    description.components = members.integer("components", 1);
    description.steps = members.integer("steps", 1);
    readFieldNames(members, description);
    if (members.has("times")) {
        description.times = members.numbers("times", 0);
        if (static_cast<std::int64_t>(description.times.size()) != description.steps)
            members.fail("times", "must have one number per step");
    }
    readPlacement(file, members, description);
    description.units = members.word("units", "");
    description.anatomical = members.truth("anatomical", false);
    description.valueScale = members.number("value_scale", 1.0);
    description.valueOffset = members.number("value_offset", 0.0);
    if (description.valueScale == 0.0) members.fail("value_scale", "must not be 0");
    description.unknownMembers = unknownMembers(object);
    return description;
}

} // namespace voxsheet::import
