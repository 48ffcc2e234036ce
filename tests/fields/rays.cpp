#include "fields/rays.h"

#include <cmath>
#include <limits>

namespace voxsheet::fields {
namespace {

/// Cuts the range to dot(normal, p) >= offset, `outward` = the unit normal to the removed side.
void keep(KeptRange& range, const WorldRay& ray, const glm::dvec3& normal, double offset,
          const glm::dvec3& outward, int cutPlane) {
    const double advance = glm::dot(normal, ray.direction);
    const double beyond = glm::dot(normal, ray.origin) - offset;
    if (advance == 0.0) {
        if (beyond < 0.0) range.end = range.begin;
        return;
    }
    const double crossing = -beyond / advance;
    if (advance > 0.0 && crossing > range.begin) {
        range.begin = crossing;
        range.entryNormal = outward;
        range.cutPlane = cutPlane;
        range.fromEye = false;
    }
    if (advance < 0.0 && crossing < range.end) {
        range.end = crossing;
        range.exitNormal = outward;
    }
}

} // namespace

WorldRay worldRay(const TileSpec& tile, double x, double y) {
    const auto& camera = tile.camera;
    const auto worldFromView = glm::inverse(camera.viewFromWorld);
    const glm::dvec2 size(tile.sizePixels);
    const auto ndc = glm::dvec2(x, y) / size * 2.0 - 1.0;
    const double aspect = size.x / size.y;
    const glm::dmat3 rotation(worldFromView);
    if (camera.projection == Projection::Perspective) {
        const double tangent = std::tan(glm::radians(camera.fovYDegrees) / 2.0);
        return {glm::dvec3(worldFromView[3]),
                rotation * glm::dvec3(ndc.x * tangent * aspect, ndc.y * tangent, -1.0)};
    }
    const double half = camera.heightWorld / 2.0;
    const glm::dvec4 start(ndc.x * half * aspect, ndc.y * half, 0.0, 1.0);
    return {glm::dvec3(worldFromView * start), rotation * glm::dvec3(0.0, 0.0, -1.0)};
}

glm::dvec3 toEye(const TileSpec& tile, const WorldRay& ray) {
    if (tile.camera.projection == Projection::Perspective) return -glm::normalize(ray.direction);
    return glm::dmat3(glm::inverse(tile.camera.viewFromWorld)) * glm::dvec3(0.0, 0.0, 1.0);
}

KeptRange keptRange(const TileSpec& tile, const Grid& grid, const WorldRay& ray) {
    const auto drawn = drawnGrid(grid, tile.periodic);
    const bool perspective = tile.camera.projection == Projection::Perspective;
    KeptRange range;
    range.begin = perspective ? 0.0 : -std::numeric_limits<double>::infinity();
    range.end = std::numeric_limits<double>::infinity();
    range.fromEye = perspective;
    const auto indexFromWorld = glm::inverse(grid.worldFromIndex);
    const auto box = boxIndex(drawn);
    for (int axis = 0; axis < 3; ++axis) {
        // index_axis(p) = dot(row, p) + w
        const glm::dvec3 row(indexFromWorld[0][axis], indexFromWorld[1][axis], indexFromWorld[2][axis]);
        const double w = indexFromWorld[3][axis];
        const auto outward = glm::normalize(row);
        keep(range, ray, row, box.low[axis] - w, -outward, -1);
        keep(range, ray, -row, -(box.high[axis] - w), outward, -1);
    }
    for (std::size_t i = 0; i < tile.clip.planes.size(); ++i) {
        const auto& plane = tile.clip.planes[i];
        keep(range, ray, plane.normal, plane.offset, -plane.normal, static_cast<int>(i));
    }
    return range;
}

} // namespace voxsheet::fields
