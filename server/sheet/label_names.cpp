#include "sheet/label_names.h"

#include "base/errors.h"
#include "sheet/number_text.h"
#include "sheet/utf8.h"

#include <cmath>

namespace voxsheet::sheet {

namespace {

constexpr double kLargestLabel = 9e15; ///< whole numbers up to here are exact

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ')
        text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ')
        text.remove_suffix(1);
    return text;
}

[[noreturn]] void refuse(std::string_view part, const char* why) {
    throw InvalidInput("labels.names", inQuotes(std::string(part)) + " " + why,
                       "write for example 1: liver; 2: spleen #aa3300")
        .withField("labels.names");
}

/// A colour at the end, taken off the text.
std::optional<Colour> takeColour(std::string_view& text) {
    const auto hash = text.rfind('#');
    if (hash == std::string_view::npos || (hash > 0 && text[hash - 1] != ' ')) return std::nullopt;
    const auto colour = parseColour(text.substr(hash));
    if (colour) text = trimmed(text.substr(0, hash));
    return colour;
}

} // namespace

std::map<std::int64_t, LabelName> parseLabelNames(std::string_view text) {
    std::map<std::int64_t, LabelName> names;
    while (!text.empty()) {
        const auto end = text.find(';');
        const std::string_view part = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (part.empty()) continue;
        const auto colon = part.find(':');
        std::string_view value = part.substr(0, colon);
        std::string_view rest = colon == std::string_view::npos ? std::string_view{} : part.substr(colon + 1);
        LabelName label;
        label.colour = takeColour(colon == std::string_view::npos ? value : rest);
        label.name = std::string(trimmed(rest));
        const auto number = parseNumber(trimmed(value));
        if (!number || *number != std::round(*number) || std::abs(*number) > kLargestLabel)
            refuse(part, "does not begin with a whole number");
        if (label.name.empty() && !label.colour) refuse(part, "has no name and no colour");
        if (!names.emplace(static_cast<std::int64_t>(*number), std::move(label)).second)
            refuse(part, "names a value for the second time");
    }
    if (names.empty()) refuse(text, "names no label");
    return names;
}

} // namespace voxsheet::sheet
