#include "import/formats/label_set.h"

#include "import/formats/number_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace voxsheet::import {

namespace {

using nlohmann::json;

constexpr std::size_t kLongestNameBytes = 200;
constexpr std::int64_t kLargestLabel = std::int64_t{1} << 53;

/// Headers need not be UTF-8, descriptions of datasets must be.
std::string validName(std::string_view text) {
    const json quoted = std::string(trimmed(text).substr(0, kLongestNameBytes));
    return json::parse(quoted.dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

} // namespace

bool LabelSet::add(std::int64_t value, std::string_view name, std::optional<glm::dvec3> rgb) {
    if (value < -kLargestLabel || value > kLargestLabel || labels_.size() >= kMostLabels) return false;
    return labels_.emplace(value, LabelMeta{value, validName(name), rgb}).second;
}

std::vector<LabelMeta> LabelSet::list() const {
    std::vector<LabelMeta> list;
    for (const auto& [value, label] : labels_)
        list.push_back(label);
    return list;
}

std::optional<glm::dvec3> hexColour(std::string_view text) {
    static constexpr std::string_view digits = "0123456789abcdef";
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    const auto lower = lowerCase(text);
    glm::dvec3 rgb{0.0};
    for (int channel = 0; channel < 3; ++channel) {
        const auto at = 1 + 2 * static_cast<std::size_t>(channel);
        const auto high = digits.find(lower[at]);
        const auto low = digits.find(lower[at + 1]);
        if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
        rgb[channel] = static_cast<double>(16 * high + low) / 255.0;
    }
    return rgb;
}

std::optional<glm::dvec3> colourOf(std::string_view numbers, double full) {
    const auto list = parseNumbers(numbers, 3);
    if (!list || std::any_of(list->begin(), list->end(), [&](double c) { return c < 0.0 || c > full; }))
        return std::nullopt;
    return glm::dvec3((*list)[0], (*list)[1], (*list)[2]) / full;
}

} // namespace voxsheet::import
