#include "engine/label_table.h"

#include "base/errors.h"
#include "sheet/label_names.h"
#include "sheet/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace voxsheet::engine {

namespace {

double displayOf(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

/// Lightness [0, 1], chroma and hue of Ottosson's Oklab (2020) as display sRGB, clipped to its gamut.
glm::dvec3 displayOfOklab(double lightness, double chroma, double hueRadians) {
    const double a = chroma * std::cos(hueRadians);
    const double b = chroma * std::sin(hueRadians);
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
    const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
    const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return {displayOf(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            displayOf(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            displayOf(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

bool holdsWholeNumbers(const FieldMeta& field) {
    return !isFloat(field.storedType) && field.valueScale == 1.0 &&
           field.valueOffset == std::round(field.valueOffset);
}

/// Whether some sample may have the value: its bin of the histogram is not empty.
bool mayBePresent(const FieldStep& data, std::int64_t value) {
    const Histogram& histogram = data.histogram;
    const auto wanted = static_cast<double>(value);
    if (wanted < data.statistics.min || wanted > data.statistics.max) return false;
    const auto bins = static_cast<double>(histogram.counts.size());
    const double width = histogram.high - histogram.low;
    const double position = width > 0.0 ? (wanted - histogram.low) / width : 0.0;
    return histogram.counts[static_cast<std::size_t>(std::clamp(position * bins, 0.0, bins - 1.0))] > 0;
}

/// The values that some sample has; empty where bins of the histogram hold several numbers.
std::set<std::int64_t> presentValues(const FieldStep& data) {
    const auto low = static_cast<std::int64_t>(std::llround(data.statistics.min));
    const auto high = static_cast<std::int64_t>(std::llround(data.statistics.max));
    std::set<std::int64_t> values;
    if (static_cast<std::size_t>(high - low) >= data.histogram.counts.size()) return values;
    for (std::int64_t value = low; value <= high; ++value)
        if (mayBePresent(data, value)) values.insert(value);
    return values;
}

glm::dvec3 rgbOf(const sheet::Colour& colour) { return {colour.red(), colour.green(), colour.blue()}; }

struct NamedLabel {
    std::string name;
    std::optional<glm::dvec3> rgb;
    bool byStyle = false; ///< at least in part
};

/// What the style says, over what the file says.
std::map<std::int64_t, NamedLabel> namedLabels(const sheet::LabelsStyle& style,
                                               const std::vector<LabelMeta>& own) {
    std::map<std::int64_t, NamedLabel> names;
    for (const auto& label : own)
        names.emplace(label.value, NamedLabel{label.name, label.rgb, false});
    if (style.names.empty()) return names;
    for (const auto& [value, said] : sheet::parseLabelNames(style.names)) {
        auto& label = names[value];
        label.byStyle = true;
        if (!said.name.empty()) label.name = said.name;
        if (said.colour) label.rgb = rgbOf(*said.colour);
    }
    return names;
}

} // namespace

glm::dvec3 labelColour(std::int64_t value) {
    constexpr double lightness[] = {0.72, 0.58, 0.84};
    constexpr double chroma[] = {0.16, 0.17, 0.12};
    const auto tone = static_cast<std::size_t>(((value % 3) + 3) % 3);
    const double goldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double hue = std::fmod(0.5 + static_cast<double>(value - 1) * goldenAngle, 2.0 * std::numbers::pi);
    return displayOfOklab(lightness[tone], chroma[tone], hue);
}

std::string LabelTable::nameOf(double value) const {
    const auto whole = static_cast<std::int64_t>(std::llround(value));
    const auto found = std::lower_bound(labels.begin(), labels.end(), whole,
                                        [](const Label& label, std::int64_t v) { return label.value < v; });
    if (found != labels.end() && found->value == whole) return found->name;
    return std::to_string(whole);
}

LabelTable makeLabelTable(const sheet::LabelsStyle& style, const std::vector<LabelMeta>& own,
                          const FieldMeta& field, int step, double opacity, const std::string& key) {
    if (!holdsWholeNumbers(field))
        throw InvalidInput(key, "labels are whole numbers, and the values here are not stored as such",
                           "choose a volume of an integer type without a slope, or switch labels off")
            .withField(key);
    const FieldStep& data = field.steps.at(static_cast<std::size_t>(step));
    const auto low = static_cast<std::int64_t>(std::llround(data.statistics.min));
    const auto high = static_cast<std::int64_t>(std::llround(data.statistics.max));
    if (high - low >= kMaxLabelSpan)
        throw LimitExceeded(key,
                            "the labels run from " + std::to_string(low) + " to " + std::to_string(high) +
                                ", over more than " + std::to_string(kMaxLabelSpan) + " numbers",
                            "renumber them")
            .withField(key);

    const auto names = namedLabels(style, own);
    const auto labelOf = [&](std::int64_t value) {
        const auto named = names.find(value);
        const bool known = named != names.end();
        Label label;
        label.value = value;
        label.name = known && !named->second.name.empty() ? named->second.name : std::to_string(value);
        label.rgb = known && named->second.rgb ? *named->second.rgb : labelColour(value);
        // Tables of files name the background, too.
        const bool background = value == 0 && !(known && named->second.byStyle);
        label.hidden = style.hidden.contains(value) || background;
        return label;
    };

    LabelTable result;
    auto listed = presentValues(data);
    for (const auto& [value, name] : names)
        if (name.byStyle || mayBePresent(data, value)) listed.insert(value);
    if (!names.contains(0) || !names.at(0).byStyle) listed.erase(0);
    for (const std::int64_t value : listed)
        result.labels.push_back(labelOf(value));

    auto table = std::make_shared<TransferTable>();
    table->low = static_cast<double>(low);
    table->high = static_cast<double>(std::max(high, low + 1));
    for (std::int64_t value = low; value <= std::max(high, low + 1); ++value) {
        const Label label = labelOf(value);
        table->entries.emplace_back(glm::vec3(label.rgb), label.hidden ? 0.0F : static_cast<float>(opacity));
    }
    result.table = std::move(table);
    return result;
}

} // namespace voxsheet::engine
