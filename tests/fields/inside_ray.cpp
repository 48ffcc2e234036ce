#include "fields/index_slope.h"
#include "fields/inside.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::fields {

RayTruth::RayTruth(const TileSpec& tileSpec, const Sources& allSources, const WorldRay& worldRayOfPixel)
    : tile(tileSpec), sources(allSources), ray(worldRayOfPixel), range(keptRange(tile, sources.grid, ray)),
      textureFromWorld_(glm::inverse(worldFromTexture(placedGrid(sources.grid, tile.periodic)))) {
    const auto perDepth = glm::dmat3(textureFromWorld_) * ray.direction;
    voxelsPerDepth = glm::length(perDepth * glm::dvec3(sources.levelDims));
    lengthPerDepth = glm::length(ray.direction);
    if (sources.clip)
        clipFromWorld_ =
            glm::inverse(worldFromTexture(sources.clip->grid)) * tile.clip.object->objectFromWorld;
}

double RayTruth::value(double depth) const {
    return sources.value(glm::dvec3(textureFromWorld_ * glm::dvec4(ray.at(depth), 1.0)));
}

double RayTruth::measure(double depth) const {
    if (!sources.clip) return 1.0;
    const double distance =
        sources.clip->distance(glm::dvec3(clipFromWorld_ * glm::dvec4(ray.at(depth), 1.0)));
    if (tile.clip.object->mode == ClipMode::Clip) return distance;
    return distance == 0.0 ? -1e-300 : -distance; // inside means below 0
}

glm::dvec3 RayTruth::gradient(double depth) const {
    const auto texture = glm::dvec3(textureFromWorld_ * glm::dvec4(ray.at(depth), 1.0));
    return worldGradient(sources.grid, sources.levelDims, sources.indexSlope(texture));
}

glm::dvec3 RayTruth::objectNormal(double depth) const {
    const auto texture = glm::dvec3(clipFromWorld_ * glm::dvec4(ray.at(depth), 1.0));
    const auto inObject =
        worldGradient(sources.clip->grid, sources.clip->dims, sources.clip->indexSlope(texture));
    return glm::transpose(glm::dmat3(tile.clip.object->objectFromWorld)) * inObject;
}

glm::dvec3 RayTruth::lit(const glm::dvec3& rgb, const glm::dvec3& normalWorld) const {
    return tile.shading.enabled ? phong(rgb, normalWorld) : rgb;
}

glm::dvec3 RayTruth::phong(const glm::dvec3& rgb, const glm::dvec3& normalWorld) const {
    const auto& shading = tile.shading;
    const double magnitude = glm::length(normalWorld);
    if (!(magnitude > 0.0)) return rgb;
    const auto eye = toEye(tile, ray);
    auto normal = normalWorld / magnitude;
    if (glm::dot(normal, eye) < 0.0) normal = -normal;
    glm::dvec3 colour = shading.ambient * rgb;
    const auto shine = [&](const glm::dvec3& light, double intensity) {
        const double facing = glm::dot(normal, light);
        if (facing <= 0.0) return;
        const auto mirrored = 2.0 * facing * normal - light;
        colour += intensity *
                  (shading.diffuse * facing * rgb +
                   shading.specular * std::pow(std::max(glm::dot(mirrored, eye), 0.0), shading.shininess));
    };
    shine(eye, shading.headLight);
    const auto worldFromView = glm::dmat3(glm::inverse(tile.camera.viewFromWorld));
    for (const auto& light : shading.lightsView)
        shine(worldFromView * light, shading.lightIntensity);
    return glm::min(colour, 1.0);
}

double RayTruth::crossing(double begin, double end) const {
    const double first = measure(begin);
    const double last = measure(end);
    return begin + (end - begin) * first / (first - last);
}

std::optional<double> RayTruth::lastEntry(double depth, double reach) const {
    if (!sources.clip) return std::nullopt;
    constexpr int steps = 16;
    const double step = reach / steps;
    for (int i = 0; i < steps; ++i) {
        const double far = depth - i * step;
        const double near = std::max(far - step, range.begin);
        if (!(near < far)) break;
        if (isKept(near) || !isKept(far)) continue;
        return tile.clip.object->binary ? far : crossing(near, far);
    }
    return std::nullopt;
}

std::optional<glm::dvec3> RayTruth::cutNormal(double depth) const {
    const double voxel = 1.0 / voxelsPerDepth;
    if (const auto entry = lastEntry(depth, voxel)) return objectNormal(*entry);
    if (range.cutPlane >= 0 && depth - range.begin <= voxel) return range.entryNormal;
    return std::nullopt;
}

glm::dvec3 RayTruth::sampleNormal(double depth) const {
    if (!tile.shading.enabled) return glm::dvec3(0.0);
    const auto cut = cutNormal(depth);
    return cut ? *cut : gradient(depth);
}

} // namespace voxsheet::fields
