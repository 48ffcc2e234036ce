#include "engine/crosshair.h"

#include "volume/box_extent.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::engine {

namespace {

constexpr double kGapPixels = 6.0;

glm::dvec3 axisOf(int number) {
    glm::dvec3 axis(0.0);
    axis[number] = 1.0;
    return axis;
}

std::vector<PixelLine> linesAcross(const glm::dvec2& at, glm::ivec2 sizePixels) {
    const glm::dvec2 size(sizePixels);
    std::vector<PixelLine> lines;
    const auto add = [&](const glm::dvec2& from, const glm::dvec2& to) {
        if (from.x <= to.x && from.y <= to.y) lines.push_back({from, to});
    };
    if (at.y >= 0.0 && at.y <= size.y) {
        add({0.0, at.y}, {std::min(at.x - kGapPixels, size.x), at.y});
        add({std::max(at.x + kGapPixels, 0.0), at.y}, {size.x, at.y});
    }
    if (at.x >= 0.0 && at.x <= size.x) {
        add({at.x, 0.0}, {at.x, std::min(at.y - kGapPixels, size.y)});
        add({at.x, std::max(at.y + kGapPixels, 0.0)}, {at.x, size.y});
    }
    return lines;
}

} // namespace

std::optional<glm::dvec3> crosshairWorld(const sheet::PlaneStyle& plane, const Grid& drawn) {
    if (!plane.crosshair || plane.units == sheet::PlaneUnits::World) return plane.crosshair;
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const Extent extent = extentAlong(axisOf(axis), drawn);
        point[axis] = extent.low + (*plane.crosshair)[axis] * extent.length();
    }
    return point;
}

std::optional<glm::dvec2> pixelAt(const CameraSpec& camera, const glm::dvec3& world, glm::ivec2 sizePixels) {
    const glm::dvec3 view(camera.viewFromWorld * glm::dvec4(world, 1.0));
    double halfHeight = camera.heightWorld / 2.0;
    if (camera.projection == Projection::Perspective) {
        if (view.z >= 0.0) return std::nullopt;
        halfHeight = -view.z * std::tan(glm::radians(camera.fovYDegrees) / 2.0);
    }
    const double pixelsPerUnit = sizePixels.y / 2.0 / halfHeight;
    return glm::dvec2(sizePixels.x / 2.0 + view.x * pixelsPerUnit,
                      sizePixels.y / 2.0 - view.y * pixelsPerUnit);
}

std::vector<PixelLine> crosshairLines(const TileSpec& tile, const Grid& drawn, const glm::dvec3& crosshair) {
    if (tile.technique == Technique::Plane) {
        const auto at = pixelAt(tile.camera, crosshair, tile.sizePixels);
        return at ? linesAcross(*at, tile.sizePixels) : std::vector<PixelLine>{};
    }
    std::vector<PixelLine> lines;
    for (int axis = 0; axis < 3; ++axis) {
        const Extent extent = extentAlong(axisOf(axis), drawn);
        glm::dvec3 low = crosshair;
        glm::dvec3 high = crosshair;
        low[axis] = extent.low;
        high[axis] = extent.high;
        const auto from = pixelAt(tile.camera, low, tile.sizePixels);
        const auto to = pixelAt(tile.camera, high, tile.sizePixels);
        if (from && to) lines.push_back({*from, *to});
    }
    return lines;
}

} // namespace voxsheet::engine
