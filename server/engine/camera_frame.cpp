#include "engine/camera_frame.h"

#include "volume/box_extent.h"

#include <algorithm>

namespace voxsheet::engine {

namespace {

constexpr double kSmallest = 1e-300;

/// Along the world's axes.
void uprightBox(const Grid& grid, glm::dvec3& low, glm::dvec3& high) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        const Extent extent = extentAlong(direction, grid);
        low[axis] = extent.low;
        high[axis] = extent.high;
    }
}

} // namespace

CameraFrame ownFrame(const Grid& drawn) {
    return {centreWorld(drawn), std::max(boundingRadiusWorld(drawn), kSmallest), {}};
}

FrameBounds boundsOf(const std::vector<Grid>& drawn) {
    FrameBounds bounds;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        glm::dvec3 low;
        glm::dvec3 high;
        uprightBox(drawn[i], low, high);
        bounds.low = i == 0 ? low : glm::min(bounds.low, low);
        bounds.high = i == 0 ? high : glm::max(bounds.high, high);
        bounds.largestSize = glm::max(bounds.largestSize, high - low);
        bounds.largestRadius = std::max(bounds.largestRadius, boundingRadiusWorld(drawn[i]));
    }
    const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
    for (const Grid& grid : drawn)
        bounds.radius =
            std::max(bounds.radius, glm::distance(middle, centreWorld(grid)) + boundingRadiusWorld(grid));
    return bounds;
}

CameraFrame linkedFrame(sheet::FrameMode mode, const Grid& own, const FrameBounds& bounds) {
    switch (mode) {
    case sheet::FrameMode::World:
        return {0.5 * (bounds.low + bounds.high), std::max(bounds.radius, kSmallest),
                bounds.high - bounds.low};
    case sheet::FrameMode::Centre:
        return {centreWorld(own), std::max(bounds.largestRadius, kSmallest), bounds.largestSize};
    case sheet::FrameMode::Fit:
        break;
    }
    return ownFrame(own);
}

} // namespace voxsheet::engine
