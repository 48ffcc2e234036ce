#include "fields/inside.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxsheet::fields {
namespace {

/// Depths at which the ray passes from cell to cell of the interpolant, its range's ends included: in
/// between, the value is a cubic of the depth.
std::vector<double> cellBorders(const RayTruth& ray) {
    std::vector<double> borders{ray.range.begin, ray.range.end};
    const auto textureFromWorld =
        glm::inverse(worldFromTexture(placedGrid(ray.sources.grid, ray.tile.periodic)));
    for (int axis = 0; axis < 3; ++axis) {
        const double n = ray.sources.levelDims[axis];
        const auto indexAt = [&](double depth) {
            return (textureFromWorld * glm::dvec4(ray.ray.at(depth), 1.0))[axis] * n - 0.5;
        };
        const double first = indexAt(ray.range.begin);
        const double last = indexAt(ray.range.end);
        if (first == last) continue;
        for (double border = std::ceil(std::min(first, last)); border <= std::max(first, last); border += 1.0)
            borders.push_back(ray.range.begin +
                              (ray.range.end - ray.range.begin) * (border - first) / (last - first));
    }
    std::sort(borders.begin(), borders.end());
    return borders;
}

/// Ends of the intervals of [0, 1] in which the cubic through values at 0, 1/3, 2/3, 1 is monotone.
std::vector<double> monotonePieces(const std::array<double, 4>& f) {
    // Newton's form of the interpolating cubic, as a + b t + c t^2 + d t^3.
    const double d = 4.5 * (f[3] - 3.0 * f[2] + 3.0 * f[1] - f[0]);
    const double c = 4.5 * (2.0 * f[0] - 5.0 * f[1] + 4.0 * f[2] - f[3]);
    const double b = 0.5 * (-11.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]);
    std::vector<double> ends{0.0, 1.0};
    const auto add = [&](double t) {
        if (t > 0.0 && t < 1.0) ends.push_back(t);
    };
    if (std::abs(d) < 1e-14 * (std::abs(b) + std::abs(c))) {
        if (c != 0.0) add(-b / (2.0 * c));
    } else if (const double inside = c * c - 3.0 * d * b; inside > 0.0) {
        add((-c + std::sqrt(inside)) / (3.0 * d));
        add((-c - std::sqrt(inside)) / (3.0 * d));
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

double rootBetween(const RayTruth& ray, double isovalue, double low, double high) {
    const bool below = ray.value(low) < isovalue;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        if ((ray.value(middle) < isovalue) == below)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

void addRoots(const RayTruth& ray, int surface, double begin, double end, std::vector<IsoHit>& hits) {
    const double isovalue = ray.tile.isosurface.surfaces[static_cast<std::size_t>(surface)].value;
    std::array<double, 4> f{};
    for (std::size_t i = 0; i < f.size(); ++i)
        f[i] = ray.value(begin + (end - begin) * static_cast<double>(i) / 3.0);
    if (std::any_of(f.begin(), f.end(), [](double v) { return std::isnan(v); })) return;
    const auto ends = monotonePieces(f);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const double low = begin + (end - begin) * ends[i - 1];
        const double high = begin + (end - begin) * ends[i];
        if ((ray.value(low) < isovalue) != (ray.value(high) < isovalue))
            hits.push_back({rootBetween(ray, isovalue, low, high), surface});
    }
}

} // namespace

std::vector<IsoHit> isoHits(const RayTruth& ray) {
    std::vector<IsoHit> hits;
    if (!(ray.range.begin < ray.range.end)) return hits;
    const auto borders = cellBorders(ray);
    for (std::size_t i = 1; i < borders.size(); ++i)
        if (borders[i] > borders[i - 1])
            for (int surface = 0; surface < static_cast<int>(ray.tile.isosurface.surfaces.size()); ++surface)
                addRoots(ray, surface, borders[i - 1], borders[i], hits);
    std::erase_if(hits, [&](const IsoHit& hit) { return !ray.isKept(hit.depth); });
    std::sort(hits.begin(), hits.end(), [](const IsoHit& a, const IsoHit& b) { return a.depth < b.depth; });
    return hits;
}

} // namespace voxsheet::fields
