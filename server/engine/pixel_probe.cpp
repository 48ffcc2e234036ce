#include "engine/pixel_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::engine {

namespace {

double opacityOf(const TransferTable& table, double value) {
    return std::isnan(value) ? 0.0 : classify(table, value).w;
}

} // namespace

float LevelSamples::at(const glm::dvec3& texture) const {
    const glm::dvec3 p = texture * glm::dvec3(dims) - 0.5;
    const glm::dvec3 base = glm::floor(p);
    const glm::dvec3 w = p - base;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 index(base);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const bool next = ((corner >> axis) & 1) != 0;
            index[axis] += next ? 1 : 0;
            weight *= next ? w[axis] : 1.0 - w[axis];
            if (periodic[axis]) {
                index[axis] = ((index[axis] % dims[axis]) + dims[axis]) % dims[axis];
            } else {
                index[axis] = std::clamp(index[axis], 0, dims[axis] - 1);
            }
        }
        const auto at = (static_cast<std::size_t>(index.z) * static_cast<std::size_t>(dims.y) +
                         static_cast<std::size_t>(index.y)) *
                            static_cast<std::size_t>(dims.x) +
                        static_cast<std::size_t>(index.x);
        if (weight > 0.0) sum += weight * static_cast<double>(values[at]);
    }
    return static_cast<float>(sum);
}

Ray pixelRay(const CameraSpec& camera, glm::dvec2 pixel, glm::ivec2 sizePixels) {
    const glm::dmat4 worldFromView = glm::inverse(camera.viewFromWorld);
    const double aspect = static_cast<double>(sizePixels.x) / static_cast<double>(sizePixels.y);
    const glm::dvec2 ndc(2.0 * pixel.x / sizePixels.x - 1.0, 1.0 - 2.0 * pixel.y / sizePixels.y);
    glm::dvec4 origin(0.0, 0.0, 0.0, 1.0);
    glm::dvec4 direction(0.0, 0.0, -1.0, 0.0);
    if (camera.projection == Projection::Perspective) {
        const double half = std::tan(glm::radians(camera.fovYDegrees) / 2.0);
        direction = {ndc.x * half * aspect, ndc.y * half, -1.0, 0.0};
    } else {
        origin = {ndc.x * camera.heightWorld / 2.0 * aspect, ndc.y * camera.heightWorld / 2.0, 0.0, 1.0};
    }
    return {glm::dvec3(worldFromView * origin), glm::normalize(glm::dvec3(worldFromView * direction))};
}

std::optional<RaySpan> spanInBox(const Ray& ray, const Grid& grid) {
    const glm::dmat4 indexFromWorld = glm::inverse(grid.worldFromIndex);
    const glm::dvec3 origin(indexFromWorld * glm::dvec4(ray.origin, 1.0));
    const glm::dvec3 direction(indexFromWorld * glm::dvec4(ray.direction, 0.0));
    const IndexBox box = boxIndex(grid);
    RaySpan span{0.0, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) return std::nullopt;
            continue;
        }
        const double a = (box.low[axis] - origin[axis]) / direction[axis];
        const double b = (box.high[axis] - origin[axis]) / direction[axis];
        span.enter = std::max(span.enter, std::min(a, b));
        span.leave = std::min(span.leave, std::max(a, b));
    }
    if (span.enter >= span.leave) return std::nullopt;
    return span;
}

std::optional<glm::dvec3> pointUnderPixel(const TileSpec& tile, const Grid& grid, const LevelSamples& level,
                                          glm::dvec2 pixel) {
    const Ray ray = pixelRay(tile.camera, pixel, tile.sizePixels);
    const auto span = spanInBox(ray, grid);
    if (!span) return std::nullopt;
    const glm::dmat4 textureFromWorld = glm::inverse(worldFromTexture(grid));
    const glm::dvec3 perLength =
        glm::dvec3(textureFromWorld * glm::dvec4(ray.direction, 0.0)) * glm::dvec3(level.dims);
    const double step = 0.5 / std::max(glm::length(perLength), 1e-300);
    const int steps =
        std::max(1, static_cast<int>(std::min(1e5, std::ceil((span->leave - span->enter) / step))));
    const double length = (span->leave - span->enter) / steps;
    double transmittance = 1.0;
    double largest = -std::numeric_limits<double>::infinity();
    std::optional<glm::dvec3> largestAt;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 world = ray.origin + (span->enter + (i + 0.5) * length) * ray.direction;
        const auto value =
            static_cast<double>(level.at(glm::dvec3(textureFromWorld * glm::dvec4(world, 1.0))));
        if (tile.technique == Technique::Mip) {
            if (value > largest) {
                largest = value;
                largestAt = world;
            }
            continue;
        }
        transmittance *= std::pow(1.0 - opacityOf(*tile.transfer, value), length / tile.unitLengthWorld);
        if (transmittance < 0.5) return world;
    }
    if (largestAt) return largestAt;
    const double middle = glm::dot(centreWorld(grid) - ray.origin, ray.direction);
    return ray.origin + std::clamp(middle, span->enter, span->leave) * ray.direction;
}

} // namespace voxsheet::engine
