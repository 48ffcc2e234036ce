#include "engine/kept_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::engine {

namespace {

/// Where the measure, linear from `begin` to `end`, is 0; its signs there differ.
double crossing(const RaySpan& stretch, double atBegin, double atEnd) {
    return stretch.begin + stretch.length() * std::clamp(atBegin / (atBegin - atEnd), 0.0, 1.0);
}

std::optional<KeptSpan> spanInBox(const Ray& ray, const Grid& grid) {
    const glm::dmat4 indexFromWorld = glm::inverse(grid.worldFromIndex);
    const glm::dvec3 origin(indexFromWorld * glm::dvec4(ray.origin, 1.0));
    const glm::dvec3 direction(indexFromWorld * glm::dvec4(ray.direction, 0.0));
    const IndexBox box = boxIndex(grid);
    KeptSpan kept{{0.0, std::numeric_limits<double>::infinity()}, false, true};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) return std::nullopt;
            continue;
        }
        const double a = (box.low[axis] - origin[axis]) / direction[axis];
        const double b = (box.high[axis] - origin[axis]) / direction[axis];
        if (std::min(a, b) > kept.span.begin) {
            kept.span.begin = std::min(a, b);
            kept.atEye = false;
        }
        kept.span.end = std::min(kept.span.end, std::max(a, b));
    }
    return kept;
}

} // namespace

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

std::optional<KeptSpan> keptSpan(const Ray& ray, const Grid& grid, const std::vector<ClipPlane>& planes) {
    auto kept = spanInBox(ray, grid);
    if (!kept) return std::nullopt;
    for (const ClipPlane& plane : planes) {
        const double advance = glm::dot(plane.normal, ray.direction);
        const double beyond = glm::dot(plane.normal, ray.origin) - plane.offset;
        if (advance == 0.0) {
            if (beyond < 0.0) return std::nullopt;
            continue;
        }
        const double depth = -beyond / advance;
        if (advance < 0.0) {
            kept->span.end = std::min(kept->span.end, depth);
        } else if (depth > kept->span.begin) {
            kept->span.begin = depth;
            kept->cut = true;
            kept->atEye = false;
        }
    }
    if (kept->span.begin >= kept->span.end) return std::nullopt;
    return kept;
}

ObjectCut::ObjectCut(const Ray& ray, const ClipObject& object, const ObjectSamples& samples)
    : object_(object), distances_(*samples.distances) {
    const glm::dmat4 textureFromWorld = glm::inverse(worldFromTexture(samples.grid)) * object.objectFromWorld;
    textureRay_.origin = glm::dvec3(textureFromWorld * glm::dvec4(ray.origin, 1.0));
    textureRay_.direction = glm::dvec3(textureFromWorld * glm::dvec4(ray.direction, 0.0));
}

double ObjectCut::measure(double depth) const {
    const glm::dvec3 texture = textureRay_.at(depth);
    const auto distance =
        static_cast<double>(object_.binary ? distances_.nearest(texture) : distances_.at(texture));
    return object_.mode == ClipMode::Probe ? -distance : distance;
}

bool ObjectCut::isKept(double measure) const {
    return object_.mode == ClipMode::Probe ? measure > 0.0 : measure >= 0.0;
}

std::optional<RaySpan> ObjectCut::keptPart(const RaySpan& stretch) const {
    if (object_.binary)
        return keeps(stretch.begin + 0.5 * stretch.length()) ? std::optional(stretch) : std::nullopt;
    const double atBegin = measure(stretch.begin);
    const double atEnd = measure(stretch.end);
    const bool first = isKept(atBegin);
    const bool last = isKept(atEnd);
    if (first == last) return first ? std::optional(stretch) : std::nullopt;
    const double at = crossing(stretch, atBegin, atEnd);
    return first ? RaySpan{stretch.begin, at} : RaySpan{at, stretch.end};
}

std::optional<double> ObjectCut::entry(const RaySpan& stretch) const {
    const double atBegin = measure(stretch.begin);
    const double atEnd = measure(stretch.end);
    if (isKept(atBegin) || !isKept(atEnd)) return std::nullopt;
    return object_.binary ? stretch.end : crossing(stretch, atBegin, atEnd);
}

} // namespace voxsheet::engine
