#include "techniques/isosurface/surface_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace voxsheet {
namespace {

constexpr float kNever = std::numeric_limits<float>::max();

std::vector<Isosurface> sortedByTexel(const IsosurfaceSpec& spec, const ResidentVolume& volume) {
    auto surfaces = spec.surfaces;
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const Isosurface& a, const Isosurface& b) { return a.value < b.value; });
    if (volume.valueScale < 0.0) std::reverse(surfaces.begin(), surfaces.end());
    return surfaces;
}

double texelOf(double value, const ResidentVolume& volume) {
    return (value - volume.valueOffset) / volume.valueScale;
}

/// (s, t): a texel is inside when s * texel >= t. `above`: at or above the value, else at or below.
glm::vec2 insideTest(double value, bool above, const ResidentVolume& volume) {
    const double sign = (above ? 1.0 : -1.0) * (volume.valueScale < 0.0 ? -1.0 : 1.0);
    return {sign, sign * texelOf(value, volume)};
}

void setCaps(SurfaceTexels& surfaces, const IsosurfaceSpec& spec, const ResidentVolume& volume) {
    std::optional<double> smallestPositive;
    std::optional<double> largestNegative;
    std::optional<double> smallest;
    for (const auto& surface : spec.surfaces) {
        const double value = surface.value;
        if (value > 0.0) smallestPositive = std::min(value, smallestPositive.value_or(value));
        if (value < 0.0) largestNegative = std::max(value, largestNegative.value_or(value));
        smallest = std::min(value, smallest.value_or(value));
    }
    const glm::vec2 never(0.0F, kNever);
    const bool neither = !smallestPositive && !largestNegative && smallest;
    surfaces.cap = smallestPositive ? insideTest(*smallestPositive, true, volume)
                   : neither        ? insideTest(*smallest, true, volume)
                                    : never;
    surfaces.mirroredCap = largestNegative ? insideTest(*largestNegative, false, volume) : never;
}

/// Half of 1/64 of the range, in texels: what the plain test takes for equal.
double plainTestTolerance(const ResidentVolume& volume) {
    const auto& field = volume.meta->fields.at(static_cast<std::size_t>(volume.field));
    const auto& statistics = field.steps.at(static_cast<std::size_t>(volume.step)).statistics;
    return (statistics.max - statistics.min) / std::abs(volume.valueScale) / 128.0;
}

} // namespace

SurfaceTexels surfaceTexels(const IsosurfaceSpec& spec, const ResidentVolume& volume) {
    SurfaceTexels surfaces;
    for (const auto& surface : sortedByTexel(spec, volume)) {
        surfaces.values.push_back(surface.value);
        surfaces.texels.push_back(static_cast<float>(texelOf(surface.value, volume)));
        surfaces.colours.push_back(surface.colour);
    }
    setCaps(surfaces, spec, volume);
    surfaces.plainTestTolerance = static_cast<float>(plainTestTolerance(volume));
    return surfaces;
}

} // namespace voxsheet
