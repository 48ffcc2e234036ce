#include "engine/isosurface_resolver.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace voxsheet::engine {

namespace {

/// Largest channel of a surface's own colour: low values are dark in most maps, and light makes them darker.
constexpr double kBrightness = 0.85;

/// Of the same hue and saturation, bright enough to show its shading.
glm::dvec3 brightened(const glm::dvec3& rgb) {
    const double largest = std::max({rgb.x, rgb.y, rgb.z});
    if (largest <= 0.0) return glm::dvec3(kBrightness);
    return largest < kBrightness ? rgb * (kBrightness / largest) : rgb;
}

/// The last one repeats.
template <typename T>
const T& repeating(const std::vector<T>& list, std::size_t index) {
    return list[std::min(index, list.size() - 1)];
}

bool hasValue(const std::vector<Isosurface>& surfaces, double value) {
    return std::any_of(surfaces.begin(), surfaces.end(),
                       [value](const Isosurface& each) { return each.value == value; });
}

/// The part of a diverging map's half, from its neutral colour on, that surfaces take no colours from.
constexpr double kPalePart = 0.7;

/// The value from whose colour a surface has its own: on the same side of 0, in the same order, never near
/// it.
double awayFromZero(const TransferFunction& function, double value) {
    const double zero = transferPosition(function, 0.0);
    const double position = transferPosition(function, value);
    if (value == 0.0 || !(zero > 0.0 && zero < 1.0)) return value;
    const double end = value > 0.0 ? 1.0 : 0.0;
    const double part = std::clamp((position - zero) / (end - zero), 0.0, 1.0);
    return transferValue(function, zero + (kPalePart + (1.0 - kPalePart) * part) * (end - zero));
}

glm::dvec3 automaticColour(const TransferFunction& function, double value, bool paleAtZero) {
    const double from = paleAtZero ? awayFromZero(function, value) : value;
    return brightened(glm::dvec3(evaluateTransfer(function, from)));
}

std::string sixDigits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

glm::vec4 givenColour(const sheet::IsosurfaceStyle& style, std::size_t surface, double opacity) {
    const sheet::Colour& colour = repeating(style.colours, surface);
    return glm::vec4(glm::dvec4(colour.red(), colour.green(), colour.blue(), colour.alpha() * opacity));
}

} // namespace

std::vector<Isosurface> resolveSurfaces(const sheet::IsosurfaceStyle& style, const TransferFunction& function,
                                        const ValueSummary& summary, bool paleAtZero) {
    const std::vector<double> values =
        style.values.empty() ? defaultIsovalues(summary, {function.low, function.high}) : style.values;
    std::vector<Isosurface> surfaces;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double opacity = style.opacities.empty() ? 1.0 : repeating(style.opacities, i);
        for (const double value : {values[i], style.mirror ? -values[i] : values[i]}) {
            if (hasValue(surfaces, value)) continue;
            const glm::vec4 colour =
                style.colours.empty()
                    ? glm::vec4(glm::dvec4(automaticColour(function, value, paleAtZero), opacity))
                    : givenColour(style, surfaces.size(), opacity);
            surfaces.push_back({value, colour});
        }
    }
    if (surfaces.size() > kMaxIsosurfaces) {
        throw InvalidInput("isosurfaces",
                           "with their mirror images they are " + std::to_string(surfaces.size()) +
                               ", and a picture shows at most " + std::to_string(kMaxIsosurfaces),
                           "give fewer values, or switch isosurface.mirror off")
            .withField(style.mirror ? "isosurface.mirror" : "isovalue");
    }
    return surfaces;
}

IsosurfaceSpec resolveIsosurface(const sheet::IsosurfaceStyle& style, const TransferFunction& function,
                                 const ValueSummary& summary, bool paleAtZero) {
    IsosurfaceSpec spec;
    spec.surfaces = resolveSurfaces(style, function, summary, paleAtZero);
    spec.caps = style.caps;
    spec.method = style.method == sheet::IsosurfaceMethod::AlphaTest ? IsosurfaceMethod::AlphaTest
                                                                     : IsosurfaceMethod::Refined;
    return spec;
}

std::string emptySurfacesNote(const std::vector<Isosurface>& surfaces, const ValueSummary& own) {
    if (surfaces.empty() || own.quantiles.empty()) return {};
    const auto outside = [&](const Isosurface& each) { return each.value < own.min || each.value > own.max; };
    if (!std::all_of(surfaces.begin(), surfaces.end(), outside)) return {};
    std::string values;
    for (const Isosurface& each : surfaces)
        values += (values.empty() ? "" : ", ") + sixDigits(each.value);
    return "no surface is drawn: the data's values go from " + sixDigits(own.min) + " to " +
           sixDigits(own.max) + ", and " +
           (surfaces.size() == 1 ? "the isovalue is " + values : "the isovalues are " + values) +
           "; set isovalue to a value between them";
}

} // namespace voxsheet::engine
