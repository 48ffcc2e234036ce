#include "import/client/import_options_json.h"

#include "base/errors.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>

namespace voxsheet::import {

namespace {

using nlohmann::json;

[[noreturn]] void reject(const std::string& member, const std::string& why) {
    throw InvalidInput("import option '" + member + "'", why).withField("options." + member);
}

double number(const std::string& member, const json& j) {
    if (!j.is_number()) reject(member, "it must be a number");
    const auto value = j.get<double>();
    if (!std::isfinite(value)) reject(member, "it must be a finite number");
    return value;
}

std::int64_t integer(const std::string& member, const json& j, std::int64_t low, std::int64_t high) {
    if (!j.is_number_integer() || (j.is_number_unsigned() && j.get<std::uint64_t>() > INT64_MAX) ||
        j.get<std::int64_t>() < low || j.get<std::int64_t>() > high)
        reject(member,
               "it must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    return j.get<std::int64_t>();
}

bool boolean(const std::string& member, const json& j) {
    if (!j.is_boolean()) reject(member, "it must be true or false");
    return j.get<bool>();
}

const json& three(const std::string& member, const json& j) {
    if (!j.is_array() || j.size() != 3) reject(member, "it must be a list of three, for x, y and z");
    return j;
}

glm::dvec3 numbers(const std::string& member, const json& j) {
    three(member, j);
    return {number(member, j[0]), number(member, j[1]), number(member, j[2])};
}

glm::bvec3 booleans(const std::string& member, const json& j) {
    three(member, j);
    return {boolean(member, j[0]), boolean(member, j[1]), boolean(member, j[2])};
}

glm::dvec3 spacing(const std::string& member, const json& j) {
    const auto value = numbers(member, j);
    if (!(value.x > 0.0 && value.y > 0.0 && value.z > 0.0)) reject(member, "every number must be above 0");
    return value;
}

glm::ivec3 dims(const std::string& member, const json& j) {
    three(member, j);
    glm::ivec3 value;
    for (int axis = 0; axis < 3; ++axis)
        value[axis] = static_cast<int>(integer(member, j[static_cast<std::size_t>(axis)], 1, 1 << 24));
    return value;
}

ScalarType type(const std::string& member, const json& j) {
    if (const auto found = j.is_string() ? scalarFromName(j.get<std::string>()) : std::nullopt) return *found;
    reject(member, "it must be one of u8, i8, u16, i16, u32, i32, u64, i64, f32, f64");
}

bool bigEndian(const std::string& member, const json& j) {
    if (j == "big" || j == "little") return j == "big";
    reject(member, "it must be \"little\" or \"big\"");
}

SeriesKind series(const std::string& member, const json& j) {
    if (j == "stack") return SeriesKind::Stack;
    if (j == "steps") return SeriesKind::Steps;
    reject(member, "it must be \"stack\" or \"steps\"");
}

/// The letters of three sides that span space, in upper case.
std::string orientation(const std::string& member, const json& j) {
    auto letters = j.is_string() ? j.get<std::string>() : std::string();
    std::transform(letters.begin(), letters.end(), letters.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    const auto has = [&](const char* sides) {
        return std::count_if(letters.begin(), letters.end(),
                             [&](char letter) { return letter == sides[0] || letter == sides[1]; }) == 1;
    };
    if (letters.size() != 3 || !has("RL") || !has("AP") || !has("SI"))
        reject(member,
               "it must be three letters, one of R and L, one of A and P, one of S and I, in the order "
               "of the file's axes, such as \"LPS\"");
    return letters;
}

std::uint64_t bitMask(const std::string& member, const json& j) {
    std::uint64_t mask = 0;
    if (j.is_string()) {
        const auto text = j.get<std::string>();
        const bool hex = text.starts_with("0x") || text.starts_with("0X");
        const auto* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data() + (hex ? 2 : 0), end, mask, hex ? 16 : 10);
        if (read.ec != std::errc{} || read.ptr != end) mask = 0;
    } else if (j.is_number_unsigned() || (j.is_number_integer() && j.get<std::int64_t>() > 0)) {
        mask = j.get<std::uint64_t>();
    }
    if (mask == 0)
        reject(member, "it must be a whole number of up to 64 bits that is not 0, such as \"0x7fff\"");
    return mask;
}

using Setter = std::function<void(ImportOptions&, const std::string&, const json&)>;

const std::map<std::string, Setter>& setters() {
    static const std::map<std::string, Setter> table{
        {"dims", [](auto& o, auto& m, auto& j) { o.rawDims = dims(m, j); }},
        {"type", [](auto& o, auto& m, auto& j) { o.rawType = type(m, j); }},
        {"endian", [](auto& o, auto& m, auto& j) { o.rawBigEndian = bigEndian(m, j); }},
        {"skip_bytes",
         [](auto& o, auto& m, auto& j) {
             o.rawSkipBytes = static_cast<std::uint64_t>(integer(m, j, 0, INT64_MAX / 2));
         }},
        {"components",
         [](auto& o, auto& m, auto& j) { o.rawComponents = static_cast<int>(integer(m, j, 1, 1024)); }},
        {"spacing", [](auto& o, auto& m, auto& j) { o.spacing = spacing(m, j); }},
        {"origin", [](auto& o, auto& m, auto& j) { o.origin = numbers(m, j); }},
        {"orientation", [](auto& o, auto& m, auto& j) { o.orientation = orientation(m, j); }},
        {"bit_mask", [](auto& o, auto& m, auto& j) { o.bitMask = bitMask(m, j); }},
        {"flip", [](auto& o, auto& m, auto& j) { o.flip = booleans(m, j); }},
        {"periodic",
         [](auto& o, auto& m, auto& j) {
             o.periodic = j.is_boolean() ? glm::bvec3(j.template get<bool>()) : booleans(m, j);
         }},
        {"no_data", [](auto& o, auto& m, auto& j) { o.noDataValue = number(m, j); }},
        {"resolution",
         [](auto& o, auto& m, auto& j) { o.resolution = static_cast<int>(integer(m, j, 16, 256)); }},
        {"series", [](auto& o, auto& m, auto& j) { o.series = series(m, j); }},
        {"divide_by_cell_volume", [](auto& o, auto& m, auto& j) { o.divideByCellVolume = boolean(m, j); }},
    };
    return table;
}

json vectorJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

json booleansJson(const glm::bvec3& v) { return {bool(v.x), bool(v.y), bool(v.z)}; }

} // namespace

ImportOptions importOptionsFromJson(const nlohmann::json& options) {
    ImportOptions result;
    if (options.is_null()) return result;
    if (!options.is_object())
        throw InvalidInput("import options", "they must be an object").withField("options");
    for (const auto& [member, value] : options.items()) {
        const auto setter = setters().find(member);
        if (setter == setters().end()) {
            std::string known;
            for (const auto& [name, unused] : setters())
                known += (known.empty() ? "" : ", ") + name;
            throw InvalidInput("import option '" + member.substr(0, 80) + "'", "there is no such option",
                               "use one of " + known)
                .withField("options." + member.substr(0, 80));
        }
        if (!value.is_null()) setter->second(result, member, value);
    }
    return result;
}

std::string canonicalOptions(const ImportOptions& o) {
    json j = json::object(); // its members are sorted
    if (o.rawDims) j["dims"] = {o.rawDims->x, o.rawDims->y, o.rawDims->z};
    if (o.rawType) j["type"] = scalarName(*o.rawType);
    if (o.rawBigEndian) j["endian"] = "big";
    if (o.rawSkipBytes != 0) j["skip_bytes"] = o.rawSkipBytes;
    if (o.rawComponents != 1) j["components"] = o.rawComponents;
    if (o.spacing) j["spacing"] = vectorJson(*o.spacing);
    if (o.origin) j["origin"] = vectorJson(*o.origin);
    if (o.orientation) j["orientation"] = *o.orientation;
    if (o.bitMask) j["bit_mask"] = *o.bitMask;
    if (o.flip != glm::bvec3(false)) j["flip"] = booleansJson(o.flip);
    if (o.periodic) j["periodic"] = booleansJson(*o.periodic);
    if (o.noDataValue) j["no_data"] = *o.noDataValue;
    if (o.resolution) j["resolution"] = *o.resolution;
    if (o.divideByCellVolume) j["divide_by_cell_volume"] = *o.divideByCellVolume;
    if (o.series) j["series"] = *o.series == SeriesKind::Stack ? "stack" : "steps";
    return j.dump();
}

} // namespace voxsheet::import
