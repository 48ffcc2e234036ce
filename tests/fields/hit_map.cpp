#include "fields/hit_map.h"

#include "volume/parallel_for.h"

#include <cmath>
#include <cstddef>

namespace voxsheet::fields {
namespace {

/// visit(ray) of every pixel, row by row from the bottom.
template <typename T, typename Visit>
std::vector<T> ofPixels(const TileSpec& tile, const Sources& sources, Visit visit) {
    const auto width = static_cast<std::size_t>(tile.sizePixels.x);
    std::vector<T> results(width * static_cast<std::size_t>(tile.sizePixels.y));
    parallelFor(tile.sizePixels.y, 4, [&](long first, long last) {
        for (auto y = static_cast<std::size_t>(first); y < static_cast<std::size_t>(last); ++y)
            for (std::size_t x = 0; x < width; ++x)
                results[y * width + x] =
                    visit(RayTruth(tile, sources, worldRay(tile, double(x) + 0.5, double(y) + 0.5)));
    });
    return results;
}

/// Whether two neighbouring pixels meet the same surfaces at nearly the same depths.
bool continues(const std::vector<IsoHit>& a, const std::vector<IsoHit>& b, double jump) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].surface != b[i].surface || std::abs(a[i].depth - b[i].depth) > jump) return false;
    return true;
}

FirstHit firstHit(const RayTruth& ray) {
    const auto hits = isoHits(ray);
    if (hits.empty()) return {};
    const double depth = hits.front().depth;
    auto normal = ray.gradient(depth);
    const double magnitude = glm::length(normal);
    normal = magnitude > 0.0 ? normal / magnitude : glm::dvec3(0.0);
    if (glm::dot(normal, toEye(ray.tile, ray.ray)) < 0.0) normal = -normal;
    return {hits.front().surface, ray.ray.at(depth), normal};
}

} // namespace

PixelHits isosurfaceHits(const TileSpec& tile, const Sources& sources) {
    return ofPixels<std::vector<IsoHit>>(tile, sources, shownHits);
}

PixelHits faceHits(const TileSpec& tile, const Sources& sources) {
    return ofPixels<std::vector<IsoHit>>(tile, sources, [](const RayTruth& ray) {
        std::vector<IsoHit> hits;
        if (const auto hit = faceHit(ray)) hits.push_back({hit->depth, 0});
        return hits;
    });
}

std::vector<bool> silhouettes(const PixelHits& hits, const glm::ivec2& size, double jump) {
    std::vector<bool> near(hits.size());
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * size.x + x); };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, size.y - 1); ++ny)
                for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, size.x - 1); ++nx)
                    if (!continues(hits[at(x, y)], hits[at(nx, ny)], jump)) near[at(x, y)] = true;
    return near;
}

std::vector<FirstHit> firstHits(const TileSpec& tile, const Sources& sources) {
    return ofPixels<FirstHit>(tile, sources, firstHit);
}

} // namespace voxsheet::fields
