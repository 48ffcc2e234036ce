#include "import/tiff/stack_description.h"

#include "base/errors.h"
#include "import/formats/input_file.h"
#include "import/formats/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace voxsheet::import {

namespace {

using Lookup = std::function<std::optional<std::string>(const char* key)>;

/// The members of either description, looked up by key.
class Members {
public:
    Members(const std::string& name, Lookup lookup) : name_(name), lookup_(std::move(lookup)) {}

    [[nodiscard]] std::optional<std::int64_t> count(const char* key) const {
        const auto text = lookup_(key);
        if (!text) return std::nullopt;
        const auto value = parseInteger(trimmed(*text));
        if (!value || *value < 1) refuse(key, *text, "a whole number from 1 on");
        return value;
    }
    /// ImageJ writes negative distances for stacks whose slices go downwards.
    [[nodiscard]] std::optional<double> length(const char* key) const {
        const auto value = number(key);
        if (!value || *value == 0.0) return std::nullopt;
        return std::abs(*value);
    }
    [[nodiscard]] std::optional<double> number(const char* key) const {
        const auto text = lookup_(key);
        if (!text) return std::nullopt;
        const auto value = parseNumber(trimmed(*text));
        if (!value || !std::isfinite(*value)) refuse(key, *text, "a number");
        return value;
    }
    [[nodiscard]] std::string text(const char* key) const { return lookup_(key).value_or(""); }

private:
    [[noreturn]] void refuse(const char* key, const std::string& text, const char* wanted) const {
        throw InvalidInput(name_,
                           std::string("its description says ") + key + " is '" + printable(text) +
                               "', not " + wanted,
                           "write the file again");
    }

    const std::string& name_;
    Lookup lookup_;
};

struct LengthUnit {
    const char* written;
    const char* name;
    double scale;
};

constexpr std::array<LengthUnit, 20> kLengthUnits{{
    {"micron", "µm", 1.0},   {"microns", "µm", 1.0},     {"micrometer", "µm", 1.0}, {"um", "µm", 1.0},
    {"\\u00B5m", "µm", 1.0}, {"µm", "µm", 1.0},          {"μm", "µm", 1.0},         {"\xB5m", "µm", 1.0},
    {"mm", "mm", 1.0},       {"millimeter", "mm", 1.0},  {"nm", "nm", 1.0},         {"nanometer", "nm", 1.0},
    {"cm", "mm", 10.0},      {"centimeter", "mm", 10.0}, {"inch", "mm", 25.4},      {"in", "mm", 25.4},
    {"Å", "Å", 1.0},         {"\\u00C5", "Å", 1.0},      {"m", "m", 1.0},           {"meter", "m", 1.0},
}};

void setLengthUnit(const std::string& written, StackDescription& stack) {
    const std::string text(trimmed(written));
    for (const auto& unit : kLengthUnits)
        if (text == unit.written) {
            stack.lengthUnit = unit.name;
            stack.lengthScale = unit.scale;
            return;
        }
    if (text.starts_with("pixel")) return;
    stack.lengthUnit = printable(text);
}

StackDescription parseImageJ(const std::string& name, const std::string& text) {
    std::map<std::string, std::string> values;
    std::string_view rest(text);
    while (const auto line = takeLine(rest))
        if (const auto equals = line->find('='); equals != std::string_view::npos)
            values.emplace(line->substr(0, equals), line->substr(equals + 1));
    const Members members(name, [&](const char* key) -> std::optional<std::string> {
        const auto found = values.find(key);
        return found == values.end() ? std::nullopt : std::optional(found->second);
    });
    StackDescription stack;
    stack.writer = StackDescription::Writer::ImageJ;
    stack.images = members.count("images");
    stack.channels = members.count("channels");
    stack.slices = members.count("slices");
    stack.frames = members.count("frames");
    stack.spacingZ = members.length("spacing");
    stack.frameInterval = members.length("finterval");
    setLengthUnit(members.text("unit"), stack);
    if (members.number("cf") == 0.0) { // a straight line; signed 16-bit numbers are kept so
        stack.valueScale = members.number("c1").value_or(1.0);
        stack.valueOffset = members.number("c0").value_or(0.0);
        if (stack.valueScale == 0.0) stack.valueScale = 1.0;
        const auto unit = members.text("vunit");
        if (lowerCase(unit) != "gray value") stack.valueUnit = printable(trimmed(unit));
    }
    return stack;
}

StackDescription parseOme(const std::string& name, const std::string& text) {
    const auto begin = text.find("Pixels ");
    const auto tag =
        begin == std::string::npos ? std::string() : text.substr(begin, text.find('>', begin) - begin);
    const Members members(name, [&](const char* key) -> std::optional<std::string> {
        const auto start = tag.find(" " + std::string(key) + "=\"");
        if (start == std::string::npos) return std::nullopt;
        const auto from = tag.find('"', start) + 1;
        return tag.substr(from, tag.find('"', from) - from);
    });
    StackDescription stack;
    stack.writer = StackDescription::Writer::Ome;
    stack.channels = members.count("SizeC");
    stack.slices = members.count("SizeZ");
    stack.frames = members.count("SizeT");
    const auto order = members.text("DimensionOrder");
    if (order.starts_with("XY")) stack.pageOrder = order.substr(2);
    auto sorted = stack.pageOrder;
    std::sort(sorted.begin(), sorted.end());
    if (sorted != "CTZ")
        throw InvalidInput(name, "its description says DimensionOrder is '" + printable(order) + "'",
                           "write the file again");
    stack.spacingX = members.length("PhysicalSizeX");
    stack.spacingY = members.length("PhysicalSizeY");
    const auto unit = [&](const char* key) {
        const auto written = members.text(key);
        return written.empty() ? std::string("µm") : written;
    };
    if (unit("PhysicalSizeZUnit") == unit("PhysicalSizeXUnit"))
        stack.spacingZ = members.length("PhysicalSizeZ");
    if (stack.spacingX) setLengthUnit(unit("PhysicalSizeXUnit"), stack);
    stack.frameInterval = members.length("TimeIncrement");
    return stack;
}

} // namespace

StackDescription parseStackDescription(const std::string& name, const std::string& text) {
    if (text.starts_with("ImageJ=")) return parseImageJ(name, text);
    if (text.find("<OME") != std::string::npos) return parseOme(name, text);
    return {};
}

} // namespace voxsheet::import
