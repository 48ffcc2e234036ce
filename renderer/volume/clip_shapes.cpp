#include "volume/clip_shapes.h"

#include "base/errors.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet {

namespace {

constexpr std::array<std::string_view, 5> names{"sphere", "ellipsoid", "box", "cylinder", "torus"};
constexpr std::string_view keyPrefix = "clip-shape:";

const glm::dvec3 ellipsoidSemiAxes(1.0, 0.75, 0.5);
constexpr double torusMajor = 0.7;
constexpr double torusMinor = 0.3;

/// Distance to the corner at the origin of a region that is negative in both coordinates.
double cornerDistance(const glm::dvec2& q) {
    return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, q.y), 0.0);
}

double boxDistance(const glm::dvec3& p) {
    const auto q = glm::abs(p) - 1.0;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

double cylinderDistance(const glm::dvec3& p) {
    return cornerDistance({glm::length(glm::dvec2(p)) - 1.0, std::abs(p.z) - 1.0});
}

double torusDistance(const glm::dvec3& p) {
    return glm::length(glm::dvec2(glm::length(glm::dvec2(p)) - torusMajor, p.z)) - torusMinor;
}

/// The axes by falling length, the point in the first octant.
void sortBySemiAxis(glm::dvec3& axes, glm::dvec3& point) {
    const auto order = [&](int i, int j) {
        if (axes[i] >= axes[j]) return;
        std::swap(axes[i], axes[j]);
        std::swap(point[i], point[j]);
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
}

} // namespace

std::span<const std::string_view> clipShapeNames() noexcept { return names; }

std::string_view clipShapeName(ClipShape shape) noexcept { return names[static_cast<std::size_t>(shape)]; }

std::optional<ClipShape> clipShapeFromName(std::string_view name) noexcept {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<ClipShape>(found - names.begin());
}

std::string clipShapeKey(std::string_view name) {
    const auto shape = clipShapeFromName(name);
    if (shape) return clipShapeKey(*shape);
    std::string known;
    for (const auto each : names)
        known += (known.empty() ? "" : ", ") + std::string(each);
    throw InvalidInput("clip shape '" + std::string(name) + "'", "there is none of this name",
                       "use one of " + known);
}

std::string clipShapeKey(ClipShape shape) {
    return std::string(keyPrefix) + std::string(clipShapeName(shape));
}

std::optional<ClipShape> clipShapeFromKey(std::string_view key) noexcept {
    if (!key.starts_with(keyPrefix)) return std::nullopt;
    return clipShapeFromName(key.substr(keyPrefix.size()));
}

// The closest point x of the ellipsoid has y_i = x_i (1 + t / e_i^2) for one t > -e_2^2, e_2 the shortest
// semi-axis: the root of a function that falls and is convex there, so that Newton's iteration from a point
// on its left climbs to the root and cannot overshoot (Eberly, "Distance from a Point to an Ellipse, an
// Ellipsoid, or a Hyperellipsoid", Geometric Tools, 2013). The unknown is u = 1 + t / e_2^2 > 0, which stays
// exact near the pole; a point in the plane y_2 = 0, for which the root may be the pole itself, is moved off
// it by less than the stated error, and the distance changes by no more than that.
double ellipsoidDistance(const glm::dvec3& semiAxes, const glm::dvec3& point) noexcept {
    auto e = semiAxes;
    auto y = glm::abs(point);
    sortBySemiAxis(e, y);
    y.z = std::max(y.z, 1e-12 * e.x);

    const auto stretch = e / e.z;
    const auto ratio = stretch * stretch; // 1 for the shortest
    const auto z = y / e;
    const auto numerator = ratio * z;
    double u = z.z; // here the last term alone is 1, so the function is not negative
    for (int iteration = 0; iteration < 200; ++iteration) {
        const auto denominator = ratio + (u - 1.0);
        const auto q = glm::dvec3(numerator.x / denominator.x, numerator.y / denominator.y, z.z / u);
        const double value = glm::dot(q, q) - 1.0;
        const double slope = -2.0 * (q.x * q.x / denominator.x + q.y * q.y / denominator.y + q.z * q.z / u);
        const double next = u - value / slope;
        if (!(next > u)) break; // rounding has taken over
        u = next;
    }
    const auto closest =
        glm::dvec3(ratio.x * y.x / (ratio.x + (u - 1.0)), ratio.y * y.y / (ratio.y + (u - 1.0)), y.z / u);
    const double distance = glm::distance(closest, y);
    return glm::dot(z, z) < 1.0 ? -distance : distance;
}

double clipShapeDistance(ClipShape shape, const glm::dvec3& point) noexcept {
    switch (shape) {
    case ClipShape::Sphere:
        return glm::length(point) - 1.0;
    case ClipShape::Ellipsoid:
        return ellipsoidDistance(ellipsoidSemiAxes, point);
    case ClipShape::Box:
        return boxDistance(point);
    case ClipShape::Cylinder:
        return cylinderDistance(point);
    case ClipShape::Torus:
        break;
    }
    return torusDistance(point);
}

DatasetMeta clipShapeMeta(ClipShape shape) {
    constexpr double spacing = 2.0 * kClipShapeHalfWidth / (kClipShapeSamples - 1);
    DatasetMeta meta;
    meta.key = clipShapeKey(shape);
    meta.sourcePath = meta.key;
    meta.format = "clip-shape";
    meta.grid.dims = glm::ivec3(kClipShapeSamples);
    meta.grid.centring = Centring::Point;
    meta.grid.worldFromIndex =
        glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-kClipShapeHalfWidth)), glm::dvec3(spacing));
    auto& field = meta.fields.emplace_back();
    field.name = "distance";
    field.quantity = "signed distance";
    field.storedType = ScalarType::F32;
    return meta;
}

std::vector<float> clipShapeSamples(ClipShape shape) {
    constexpr auto n = static_cast<std::size_t>(kClipShapeSamples);
    const auto worldFromIndex = clipShapeMeta(shape).grid.worldFromIndex;
    std::vector<float> samples(n * n * n);
    parallelFor(kClipShapeSamples, 1, [&](long begin, long end) {
        for (auto z = static_cast<std::size_t>(begin); z < static_cast<std::size_t>(end); ++z)
            for (std::size_t y = 0; y < n; ++y)
                for (std::size_t x = 0; x < n; ++x) {
                    const glm::dvec3 world(worldFromIndex * glm::dvec4(x, y, z, 1.0));
                    samples[(z * n + y) * n + x] = static_cast<float>(clipShapeDistance(shape, world));
                }
    });
    return samples;
}

} // namespace voxsheet
