#include "fields/inside.h"

#include "fields/index_slope.h"
#include "stages/preintegration.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace voxsheet::fields {
namespace {

struct Light {
    glm::dvec3 colour{0.0};
    double transmittance = 1.0;

    void add(const glm::dvec3& rgb, double alpha) {
        colour += transmittance * alpha * rgb;
        transmittance *= 1.0 - alpha;
    }
    [[nodiscard]] glm::dvec4 pixel() const { return {colour, 1.0 - transmittance}; }
};

/// Extinctions per world length of all volumes at a point, and their sum weighted with colours
/// (stages/layer_spec.h).
struct Matter {
    double extinction = 0.0;
    glm::dvec3 emission{0.0};

    void add(const glm::dvec4& entry, const glm::dvec3& rgb, double weight, double unitLength) {
        const double perUnit = entry.w < 1.0 ? std::min(-std::log2(1.0 - entry.w), 4096.0) : 4096.0;
        const double more = weight * perUnit / unitLength;
        extinction += more;
        emission += more * rgb;
    }
};

void addLayer(Matter& matter, const RayTruth& ray, double depth, std::size_t index) {
    const auto& source = ray.sources.layers[index];
    const auto& layer = ray.tile.layers.volumes[index];
    const auto at =
        glm::dvec3(glm::inverse(worldFromTexture(source.grid)) * glm::dvec4(ray.ray.at(depth), 1.0));
    const auto box = boxIndex(source.grid);
    constexpr double slack = 1e-6; // boxes that share a face share its points
    const auto low = (box.low + 0.5) / glm::dvec3(source.grid.dims) - slack;
    const auto high = (box.high + 0.5) / glm::dvec3(source.grid.dims) + slack;
    if (glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high))) return;
    const double value = source.value(at);
    if (std::isnan(value)) return;
    const auto entry = classify(*layer.transfer, value);
    auto rgb = glm::dvec3(entry);
    if (ray.tile.shading.enabled && entry.w > 0.0) {
        const auto cut = ray.cutNormal(depth);
        rgb = ray.lit(rgb, cut ? *cut : worldGradient(source.grid, source.levelDims, source.indexSlope(at)));
    }
    matter.add(entry, rgb, layer.weight, layer.unitLengthWorld);
}

Matter matterOfAll(const RayTruth& ray, double depth) {
    Matter matter;
    if (const double value = ray.value(depth); !std::isnan(value)) {
        const auto entry = classify(*ray.tile.transfer, value);
        matter.add(entry, ray.lit(glm::dvec3(entry), ray.sampleNormal(depth)), ray.tile.layers.ownWeight,
                   ray.tile.unitLengthWorld);
    }
    for (std::size_t i = 0; i < ray.sources.layers.size(); ++i)
        addLayer(matter, ray, depth, i);
    return matter;
}

/// Where the normal of a sample at `depth` is taken (techniques/raycast/raycast.h). Which chunks an object
/// keeps whole is not known here.
double normalDepth(const RayTruth& ray, double depth) {
    if (!pairsShareLight(ray.tile) || ray.sources.clip) return depth;
    const double step = ray.tile.sampleDistanceVoxels / ray.voxelsPerDepth;
    const double whole = std::floor((ray.range.end - ray.range.begin) / step);
    const double second = 2.0 * std::floor((depth - ray.range.begin) / (2.0 * step)) + 1.0;
    return second < whole ? ray.range.begin + second * step : depth;
}

bool isWholeStretch(const RayTruth& ray, double begin) {
    const double step = ray.tile.sampleDistanceVoxels / ray.voxelsPerDepth;
    const double whole = std::floor((ray.range.end - ray.range.begin) / step);
    return (begin - ray.range.begin) / step < whole - 0.5;
}

/// Mean per unit length over the values between two (stages/preintegration.h), by many of them.
Matter meanMatter(const TransferTable& table, double from, double to) {
    Matter mean;
    const double first = tablePosition(table, from);
    const double last = tablePosition(table, to);
    if (std::isnan(first + last)) return mean;
    const auto entries = static_cast<double>(table.entries.size());
    const int count = std::clamp(static_cast<int>(2.0 * std::abs(last - first) * entries), 1, 8192);
    for (int i = 0; i < count; ++i) {
        const double weight = (i + 0.5) / count;
        auto entry = classify(table, tableValue(table, first + weight * (last - first)));
        entry.w = std::min(entry.w, 1.0 - std::exp2(-kLargestMeanExtinction));
        mean.add(entry, glm::dvec3(entry), 1.0 / count, 1.0);
    }
    return mean;
}

/// The stretch [begin, end] of a volume, as far as it is kept, one sample in the middle of that.
void addStretch(Light& light, const RayTruth& ray, double begin, double end) {
    if (ray.sources.clip && ray.tile.clip.object->binary) {
        if (!ray.isKept(0.5 * (begin + end))) return;
    } else if (ray.sources.clip) {
        const bool first = ray.isKept(begin);
        const bool last = ray.isKept(end);
        if (!first && !last) return;
        if (first != last) (first ? end : begin) = ray.crossing(begin, end);
    }
    if (!(begin < end)) return;
    const double depth = 0.5 * (begin + end);
    const double length = (end - begin) * ray.lengthPerDepth;
    if (!ray.sources.layers.empty()) {
        const auto matter = matterOfAll(ray, depth);
        if (matter.extinction > 0.0)
            light.add(matter.emission / matter.extinction, 1.0 - std::exp2(-matter.extinction * length));
        return;
    }
    const double value = ray.value(depth);
    if (std::isnan(value)) return;
    const double exponent = length / ray.tile.unitLengthWorld;
    if (preIntegrates(ray.tile) && isWholeStretch(ray, begin)) {
        const auto mean = meanMatter(*ray.tile.transfer, ray.value(begin), ray.value(end));
        if (!(mean.extinction > 0.0)) return;
        const auto normal = ray.sampleNormal(normalDepth(ray, depth));
        light.add(ray.lit(mean.emission / mean.extinction, normal),
                  1.0 - std::exp2(-mean.extinction * exponent));
        return;
    }
    const auto entry = classify(*ray.tile.transfer, value);
    light.add(ray.lit(glm::dvec3(entry), ray.sampleNormal(normalDepth(ray, depth))),
              1.0 - std::pow(1.0 - entry.w, exponent));
}

/// Whole stretches from the front, and the shorter rest.
template <typename Take>
void overStretches(const RayTruth& ray, Take take) {
    const double step = ray.tile.sampleDistanceVoxels / ray.voxelsPerDepth;
    const double whole = std::floor((ray.range.end - ray.range.begin) / step);
    for (double i = 0.0; i <= whole; i += 1.0)
        take(ray.range.begin + i * step, std::min(ray.range.begin + (i + 1.0) * step, ray.range.end));
}

template <typename Take>
void overSlabs(const RayTruth& ray, Take take) {
    const auto& tile = ray.tile;
    const double centre = -(tile.camera.viewFromWorld *
                            glm::dvec4(centreWorld(drawnGrid(ray.sources.grid, tile.periodic)), 1.0))
                               .z;
    const auto ahead = glm::dmat3(glm::inverse(tile.camera.viewFromWorld)) * glm::dvec3(0.0, 0.0, -1.0);
    const auto voxels = glm::dmat3(glm::inverse(worldFromTexture(ray.sources.grid))) * ahead *
                        glm::dvec3(ray.sources.levelDims);
    const double thickness = tile.sampleDistanceVoxels / glm::length(voxels);
    for (double k = std::floor((ray.range.begin - centre) / thickness);
         centre + k * thickness < ray.range.end; k += 1.0)
        take(std::max(ray.range.begin, centre + k * thickness),
             std::min(ray.range.end, centre + (k + 1.0) * thickness));
}

glm::dvec4 maximumPixel(const RayTruth& ray) {
    double largest = -std::numeric_limits<double>::infinity();
    overStretches(ray, [&](double begin, double end) {
        const double depth = 0.5 * (begin + end);
        const double value = ray.value(depth);
        if (!std::isnan(value) && ray.isKept(depth)) largest = std::max(largest, value);
    });
    if (std::isinf(largest)) return glm::dvec4(0.0);
    const auto rgba = classify(*ray.tile.transfer, largest);
    const double alpha = rgba.w / largestOpacity(*ray.tile.transfer);
    return {glm::dvec3(rgba) * alpha, alpha};
}

glm::dvec4 facePixel(const RayTruth& ray) {
    const auto hit = faceHit(ray);
    if (!hit) return glm::dvec4(0.0);
    const double value = ray.value(hit->depth);
    if (std::isnan(value)) {
        const glm::dvec4 nan(ray.tile.transfer->nan);
        return {glm::dvec3(nan) * nan.w, nan.w};
    }
    return {ray.lit(glm::dvec3(classify(*ray.tile.transfer, value)), hit->normal), 1.0};
}

glm::dvec4 planeColour(const RayTruth& ray, double value) {
    if (std::isnan(value)) {
        const glm::dvec4 nan(ray.tile.transfer->nan);
        return {glm::dvec3(nan) * nan.w, nan.w};
    }
    const auto entry = classify(*ray.tile.transfer, value);
    if (ray.tile.categories && entry.w <= 0.0) return glm::dvec4(0.0);
    return {glm::dvec3(entry), 1.0};
}

/// What layer i shows at a point of the world, painted over a plane's colour.
glm::dvec4 paintedOver(const glm::dvec4& colour, const RayTruth& ray, const glm::dvec3& point,
                       std::size_t i) {
    const auto& source = ray.sources.layers[i];
    const auto& layer = ray.tile.layers.volumes[i];
    const auto index = glm::dvec3(glm::inverse(source.grid.worldFromIndex) * glm::dvec4(point, 1.0));
    const auto box = boxIndex(source.grid);
    constexpr double slack = 1e-4; // voxels: boxes that share a face share its points
    if (glm::any(glm::lessThan(index, box.low - slack)) ||
        glm::any(glm::greaterThan(index, box.high + slack)))
        return colour;
    const double value =
        source.value(glm::dvec3(glm::inverse(worldFromTexture(source.grid)) * glm::dvec4(point, 1.0)));
    if (!(value >= layer.threshold)) return colour;
    const auto entry = classify(*layer.transfer, value);
    const double alpha = layer.weight * entry.w;
    return glm::dvec4(alpha * glm::dvec3(entry), alpha) + (1.0 - alpha) * colour;
}

glm::dvec4 planePixel(const RayTruth& ray) {
    const auto& plane = ray.tile.plane;
    const auto drawn = drawnGrid(ray.sources.grid, ray.tile.periodic);
    const double advance = glm::dot(plane.normal, ray.ray.direction);
    if (advance == 0.0) return glm::dvec4(0.0);
    const auto point = ray.ray.at((plane.offset - glm::dot(plane.normal, ray.ray.origin)) / advance);
    const auto index = glm::dvec3(glm::inverse(drawn.worldFromIndex) * glm::dvec4(point, 1.0));
    const auto box = boxIndex(drawn);
    const auto slack = 1e-5 * glm::dvec3(ray.sources.grid.dims);
    if (glm::any(glm::lessThan(index, box.low - slack)) ||
        glm::any(glm::greaterThan(index, box.high + slack)))
        return glm::dvec4(0.0);
    const auto placed = placedGrid(ray.sources.grid, ray.tile.periodic);
    const auto texture = glm::dvec3(glm::inverse(worldFromTexture(placed)) * glm::dvec4(point, 1.0));
    const auto aboveBorder = 1.0 / 1024.0 / glm::dvec3(ray.sources.levelDims);
    const double value = plane.interpolation == PlaneInterpolation::Nearest
                             ? ray.sources.nearest(texture + aboveBorder)
                             : ray.sources.value(texture);
    auto colour = planeColour(ray, value);
    for (std::size_t i = 0; i < ray.sources.layers.size(); ++i)
        colour = paintedOver(colour, ray, point, i);
    return colour;
}

bool isInside(const IsosurfaceSpec& spec, double value) {
    double positive = std::numeric_limits<double>::infinity();
    double negative = -positive;
    double smallest = positive;
    for (const auto& surface : spec.surfaces) {
        if (surface.value > 0.0) positive = std::min(positive, surface.value);
        if (surface.value < 0.0) negative = std::max(negative, surface.value);
        smallest = std::min(smallest, surface.value);
    }
    if (std::isinf(positive) && std::isinf(negative)) return value >= smallest;
    return value >= positive || value <= negative;
}

/// Depths at which the ray comes into what is kept through a cut, and the cuts' normals: by planes and, in
/// steps as the technique takes them, by the object.
std::vector<FaceHit> cutEntries(const RayTruth& ray) {
    std::vector<FaceHit> entries;
    if (ray.range.cutPlane >= 0 && ray.isKept(ray.range.begin))
        entries.push_back({ray.range.begin, ray.range.entryNormal});
    if (!ray.sources.clip) return entries;
    overStretches(ray, [&](double begin, double end) {
        if (ray.isKept(begin) || !ray.isKept(end)) return;
        const double depth = ray.crossing(begin, end);
        entries.push_back({depth, ray.objectNormal(depth)});
    });
    return entries;
}

glm::dvec3 surfaceColour(const RayTruth& ray, const IsoHit& hit) {
    const auto& surface = ray.tile.isosurface.surfaces[static_cast<std::size_t>(hit.surface)];
    const glm::dvec3 own(surface.colour);
    if (!ray.sources.colour) return own;
    const auto& colour = *ray.sources.colour;
    const auto texture =
        glm::dvec3(glm::inverse(worldFromTexture(colour.grid)) * glm::dvec4(ray.ray.at(hit.depth), 1.0));
    const auto box = boxIndex(colour.grid);
    const auto low = (box.low + 0.5) / glm::dvec3(colour.grid.dims);
    const auto high = (box.high + 0.5) / glm::dvec3(colour.grid.dims);
    if (glm::any(glm::lessThan(texture, low)) || glm::any(glm::greaterThan(texture, high))) return own;
    const double value = colour.value(texture);
    return std::isnan(value) ? own : glm::dvec3(classify(*ray.tile.isosurface.colouredBy->transfer, value));
}

glm::dvec4 isosurfacePixel(const RayTruth& ray) {
    struct Event {
        double depth;
        glm::dvec3 rgb;
        double alpha;
    };
    std::vector<Event> events;
    const bool refined = ray.tile.isosurface.method == IsosurfaceMethod::Refined;
    for (const auto& hit : refined ? isoHits(ray) : plainTestHits(ray)) {
        const auto& surface = ray.tile.isosurface.surfaces[static_cast<std::size_t>(hit.surface)];
        events.push_back(
            {hit.depth, ray.lit(surfaceColour(ray, hit), ray.gradient(hit.depth)), double(surface.colour.w)});
    }
    if (refined && ray.tile.isosurface.caps)
        for (const auto& cut : cutEntries(ray))
            if (const double value = ray.value(cut.depth); isInside(ray.tile.isosurface, value))
                events.push_back(
                    {cut.depth, ray.lit(glm::dvec3(classify(*ray.tile.transfer, value)), cut.normal), 1.0});
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.depth < b.depth; });
    Light light;
    for (const auto& event : events)
        light.add(event.rgb, event.alpha);
    return light.pixel();
}

glm::dvec4 volumePixel(const RayTruth& ray) {
    // Clipping, which the range heeds, is nothing to a plane.
    if (!(ray.range.begin < ray.range.end) && ray.tile.technique != Technique::Plane) return glm::dvec4(0.0);
    Light light;
    const auto take = [&](double begin, double end) { addStretch(light, ray, begin, end); };
    switch (ray.tile.technique) {
    case Technique::Raycast:
        overStretches(ray, take);
        break;
    case Technique::Slices:
        overSlabs(ray, take);
        break;
    case Technique::Mip:
        return maximumPixel(ray);
    case Technique::Surface:
        return facePixel(ray);
    case Technique::Isosurface:
        return isosurfacePixel(ray);
    case Technique::Plane:
        return planePixel(ray);
    }
    return light.pixel();
}

/// What a solid at a depth leaves of the volume's picture.
glm::dvec4 pixelBefore(const RayTruth& ray, double depth) {
    if (ray.tile.technique == Technique::Plane) return glm::dvec4(0.0);
    if (ray.tile.technique == Technique::Surface) { // The face behind decides what its own depth is.
        const auto face = faceHit(ray);
        return face && face->depth <= depth ? volumePixel(ray) : glm::dvec4(0.0);
    }
    RayTruth before = ray;
    before.range.end = std::min(before.range.end, depth);
    return volumePixel(before);
}

glm::dvec4 pixelOf(const RayTruth& ray) {
    const auto& solids = ray.sources.solids;
    const bool flat = ray.tile.technique == Technique::Plane;
    const auto solid =
        flat ? cutSolidHit(ray.tile, solids, ray.ray) : firstSolidHit(ray.tile, solids, ray.ray);
    if (!solid) return volumePixel(ray);
    const auto before = pixelBefore(ray, solid->depth);
    const auto rgb = ray.phong(solid->rgb, solid->normal);
    return before + (1.0 - before.w) * glm::dvec4(rgb, 1.0);
}

/// Of every n-th pixel of every n-th row: visit(column, row, ray).
template <typename Visit>
void overPixels(const TileSpec& tile, const Sources& sources, Visit visit, int every = 1) {
    const auto size = (tile.sizePixels + every - 1) / every;
    parallelFor(size.y, 4, [&](long first, long last) {
        for (int y = static_cast<int>(first); y < last; ++y)
            for (int x = 0; x < size.x; ++x)
                visit(x, y, RayTruth(tile, sources, worldRay(tile, x * every + 0.5, y * every + 0.5)));
    });
}

} // namespace

std::optional<FaceHit> faceHit(const RayTruth& ray) {
    const auto& range = ray.range;
    if (!(range.begin < range.end)) return std::nullopt;
    if (!range.fromEye && ray.isKept(range.begin)) return FaceHit{range.begin, range.entryNormal};
    if (ray.sources.clip) {
        // Fine steps: the technique's own are as long as the object is far at least.
        const double step = (ray.tile.clip.object->binary ? 1.0 / 64.0 : 0.1) / ray.voxelsPerDepth;
        for (double near = range.begin; near < range.end; near += step) {
            const double far = std::min(near + step, range.end);
            if (ray.isKept(near) || !ray.isKept(far)) continue;
            const double depth = ray.tile.clip.object->binary ? far : ray.crossing(near, far);
            return FaceHit{depth, ray.objectNormal(depth)};
        }
    }
    if (range.fromEye && ray.isKept(range.end)) return FaceHit{range.end, range.exitNormal};
    return std::nullopt;
}

Picture insidePicture(const TileSpec& tile, const Sources& sources, int everyNthPixel) {
    Picture picture((tile.sizePixels + everyNthPixel - 1) / everyNthPixel);
    overPixels(
        tile, sources, [&](int x, int y, const RayTruth& ray) { picture.at(x, y) = pixelOf(ray); },
        everyNthPixel);
    return picture;
}

double keptVoxels(const TileSpec& tile, const Sources& sources) {
    double sum = 0.0;
    for (int y = 0; y < tile.sizePixels.y; ++y)
        for (int x = 0; x < tile.sizePixels.x; ++x) {
            const RayTruth ray(tile, sources, worldRay(tile, x + 0.5, y + 0.5));
            sum += std::max(0.0, ray.range.end - ray.range.begin) * ray.voxelsPerDepth;
        }
    return sum;
}

long facePixels(const TileSpec& tile, const Sources& sources) {
    std::atomic<long> count = 0;
    overPixels(tile, sources,
               [&](int, int, const RayTruth& ray) { count += faceHit(ray).has_value() ? 1 : 0; });
    return count;
}

Picture insideConverged(TileSpec tile, const Sources& sources, double stepVoxels) {
    tile.sampleDistanceVoxels = stepVoxels;
    return insidePicture(tile, sources);
}

std::vector<IsoHit> plainTestHits(const RayTruth& ray) {
    std::vector<IsoHit> hits;
    const double tolerance = ray.sources.valueRange / 128.0;
    const auto& surfaces = ray.tile.isosurface.surfaces;
    if (ray.range.begin < ray.range.end)
        overStretches(ray, [&](double begin, double end) {
            const double depth = 0.5 * (begin + end);
            if (!(begin < end) || !ray.isKept(depth)) return;
            const double value = ray.value(depth);
            for (std::size_t i = 0; i < surfaces.size(); ++i)
                if (std::abs(value - surfaces[i].value) <= tolerance)
                    hits.push_back({depth, static_cast<int>(i)});
        });
    return hits;
}

std::vector<IsoHit> shownHits(const RayTruth& ray) {
    const auto& isosurface = ray.tile.isosurface;
    const bool refined = isosurface.method == IsosurfaceMethod::Refined;
    auto hits = refined ? isoHits(ray) : plainTestHits(ray);
    if (refined && isosurface.caps)
        for (const auto& cut : cutEntries(ray))
            if (isInside(isosurface, ray.value(cut.depth))) hits.push_back({cut.depth, -1});
    std::stable_sort(hits.begin(), hits.end(),
                     [](const IsoHit& x, const IsoHit& y) { return x.depth < y.depth; });
    const auto opaque = std::find_if(hits.begin(), hits.end(), [&](const IsoHit& hit) {
        return hit.surface < 0 || isosurface.surfaces[static_cast<std::size_t>(hit.surface)].colour.w >= 1.0F;
    });
    if (opaque != hits.end()) hits.erase(opaque + 1, hits.end());
    return hits;
}

} // namespace voxsheet::fields
