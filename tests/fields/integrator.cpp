#include "fields/integrator.h"

#include "fields/rays.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace voxsheet::fields {
namespace {

struct Scene {
    const TileSpec& tile;
    const Grid& grid;
    glm::dvec3 levelDims;
    const ValueAt& value;
    glm::dmat4 textureFromWorld;
    glm::dmat4 worldFromView;
    glm::dvec3 boxLow;
    glm::dvec3 boxHigh;
};

Scene makeScene(const TileSpec& tile, const Grid& grid, const glm::ivec3& levelDims, const ValueAt& value) {
    const auto box = boxIndex(grid);
    const glm::dvec3 dims(grid.dims);
    return {tile,
            grid,
            glm::dvec3(levelDims),
            value,
            glm::inverse(worldFromTexture(grid)),
            glm::inverse(tile.camera.viewFromWorld),
            (box.low + 0.5) / dims,
            (box.high + 0.5) / dims};
}

/// The same ray in the texture frame, and where it is inside the box.
struct TextureRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
    double worldPerDepth;
    double voxelsPerDepth;
    double enter;
    double leave;
};

std::optional<TextureRay> traceBox(const Scene& scene, const WorldRay& world) {
    TextureRay ray{};
    ray.origin = glm::dvec3(scene.textureFromWorld * glm::dvec4(world.origin, 1.0));
    ray.direction = glm::dmat3(scene.textureFromWorld) * world.direction;
    ray.worldPerDepth = glm::length(world.direction);
    ray.voxelsPerDepth = glm::length(ray.direction * scene.levelDims);
    const bool perspective = scene.tile.camera.projection == Projection::Perspective;
    ray.enter = perspective ? 0.0 : -std::numeric_limits<double>::infinity();
    ray.leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double o = ray.origin[axis];
        const double d = ray.direction[axis];
        if (d == 0.0) {
            if (o < scene.boxLow[axis] || o > scene.boxHigh[axis]) return std::nullopt;
            continue;
        }
        const double a = (scene.boxLow[axis] - o) / d;
        const double b = (scene.boxHigh[axis] - o) / d;
        ray.enter = std::max(ray.enter, std::min(a, b));
        ray.leave = std::min(ray.leave, std::max(a, b));
    }
    if (!(ray.enter < ray.leave)) return std::nullopt;
    return ray;
}

/// Takes samples in order and keeps colour and transmittance, or the maximum.
class Accumulator {
public:
    explicit Accumulator(const Scene& scene) : scene_(scene) {}

    /// A sample at `depth` that stands for `length` of depth.
    void add(const TextureRay& ray, double depth, double length) {
        const double value = scene_.value(ray.origin + depth * ray.direction);
        if (std::isnan(value)) return;
        if (scene_.tile.technique == Technique::Mip) {
            largest_ = std::max(largest_, value);
            return;
        }
        const auto rgba = classify(*scene_.tile.transfer, value);
        const double exponent = length * ray.worldPerDepth / scene_.tile.unitLengthWorld;
        const double alpha = 1.0 - std::pow(1.0 - rgba.w, exponent);
        colour_ += transmittance_ * alpha * glm::dvec3(rgba);
        transmittance_ *= 1.0 - alpha;
    }

    [[nodiscard]] glm::dvec4 result() const {
        if (scene_.tile.technique != Technique::Mip) return {colour_, 1.0 - transmittance_};
        if (largest_ == -std::numeric_limits<double>::infinity()) return glm::dvec4(0.0);
        const auto rgba = classify(*scene_.tile.transfer, largest_);
        const double alpha = rgba.w / largestOpacity(*scene_.tile.transfer);
        return {glm::dvec3(rgba) * alpha, alpha};
    }

private:
    const Scene& scene_;
    glm::dvec3 colour_{0.0};
    double transmittance_ = 1.0;
    double largest_ = -std::numeric_limits<double>::infinity();
};

/// Whole stretches of `stepVoxels` from the front, each sampled in its middle, and the rest likewise.
glm::dvec4 alongRay(const Scene& scene, const TextureRay& ray, double stepVoxels) {
    const double step = stepVoxels / ray.voxelsPerDepth;
    const double stretches = (ray.leave - ray.enter) / step;
    const double whole = std::floor(stretches);
    Accumulator sum(scene);
    for (double i = 0.0; i < whole; i += 1.0)
        sum.add(ray, ray.enter + (i + 0.5) * step, step);
    const double rest = (stretches - whole) * step;
    sum.add(ray, ray.leave - 0.5 * rest, rest);
    return sum.result();
}

/// One sample for each slab [centre + k depth, centre + (k + 1) depth] of the ray's path, front to back, in
/// the path's middle.
glm::dvec4 throughSlabs(const Scene& scene, const TextureRay& ray, double centreDepth, double slabDepth) {
    Accumulator sum(scene);
    for (double slab = std::floor((ray.enter - centreDepth) / slabDepth);; slab += 1.0) {
        const double near = std::max(ray.enter, centreDepth + slab * slabDepth);
        const double far = std::min(ray.leave, centreDepth + (slab + 1.0) * slabDepth);
        if (far > near) sum.add(ray, 0.5 * (near + far), far - near);
        if (centreDepth + (slab + 1.0) * slabDepth >= ray.leave) break;
    }
    return sum.result();
}

/// Of every n-th pixel of every n-th row.
template <typename PixelOfRay>
Picture overPixels(const Scene& scene, int every, PixelOfRay pixelOfRay) {
    Picture picture((scene.tile.sizePixels + every - 1) / every);
    parallelFor(picture.size.y, 4, [&](long begin, long end) {
        for (int y = static_cast<int>(begin); y < end; ++y)
            for (int x = 0; x < picture.size.x; ++x)
                if (const auto ray = traceBox(scene, worldRay(scene.tile, x * every + 0.5, y * every + 0.5)))
                    picture.at(x, y) = pixelOfRay(*ray);
    });
    return picture;
}

} // namespace

Picture integrateLikeTechnique(const TileSpec& tile, const Grid& grid, const glm::ivec3& levelDims,
                               const ValueAt& value) {
    const auto scene = makeScene(tile, grid, levelDims, value);
    if (tile.technique != Technique::Slices)
        return overPixels(
            scene, 1, [&](const TextureRay& ray) { return alongRay(scene, ray, tile.sampleDistanceVoxels); });
    const double centreDepth = -(tile.camera.viewFromWorld * glm::dvec4(centreWorld(grid), 1.0)).z;
    const auto ahead = glm::dmat3(scene.worldFromView) * glm::dvec3(0.0, 0.0, -1.0);
    const auto voxels = glm::dmat3(scene.textureFromWorld) * ahead * scene.levelDims;
    const double slabDepth = tile.sampleDistanceVoxels / glm::length(voxels);
    return overPixels(
        scene, 1, [&](const TextureRay& ray) { return throughSlabs(scene, ray, centreDepth, slabDepth); });
}

Picture integrateConverged(const TileSpec& tile, const Grid& grid, const glm::ivec3& levelDims,
                           const ValueAt& value, double stepVoxels, int everyNthPixel) {
    const auto scene = makeScene(tile, grid, levelDims, value);
    return overPixels(scene, everyNthPixel,
                      [&](const TextureRay& ray) { return alongRay(scene, ray, stepVoxels); });
}

double pathVoxels(const TileSpec& tile, const Grid& grid, const glm::ivec3& levelDims) {
    const ValueAt none;
    const auto scene = makeScene(tile, grid, levelDims, none);
    double sum = 0.0;
    for (int y = 0; y < tile.sizePixels.y; ++y)
        for (int x = 0; x < tile.sizePixels.x; ++x)
            if (const auto ray = traceBox(scene, worldRay(tile, x + 0.5, y + 0.5)))
                sum += (ray->leave - ray->enter) * ray->voxelsPerDepth;
    return sum;
}

} // namespace voxsheet::fields
