#include "stages/ray_frame.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {

RayFrame makeRayFrame(const CameraSpec& camera, glm::ivec2 sizePixels, const Grid& grid,
                      const PeriodicWindow& window) {
    const auto drawn = drawnGrid(grid, window);
    const auto placed = placedGrid(grid, window);
    RayFrame frame;
    frame.perspective = camera.projection == Projection::Perspective;
    frame.radiusWorld = boundingRadiusWorld(drawn);
    const double radius = frame.radiusWorld;
    const double aspect = double(sizePixels.x) / double(sizePixels.y);
    const double halfHeight = frame.perspective ? std::tan(0.5 * glm::radians(camera.fovYDegrees))
                                                : 0.5 * camera.heightWorld / radius;
    frame.pictureHalf = {halfHeight * aspect, halfHeight};

    const auto textureFromView = glm::inverse(camera.viewFromWorld * worldFromTexture(placed));
    const glm::dmat3 linear(textureFromView);
    const auto right = linear[0] * radius;
    const auto up = linear[1] * radius;
    const auto ahead = -linear[2] * radius;
    frame.centreDepthWorld = -(camera.viewFromWorld * glm::dvec4(centreWorld(drawn), 1.0)).z;
    const double depth = frame.centreDepthWorld / radius;

    frame.origin = glm::dvec3(textureFromView[3]) + depth * ahead;
    frame.direction = ahead;
    if (frame.perspective) {
        frame.originX = depth * right;
        frame.originY = depth * up;
        frame.directionX = right;
        frame.directionY = up;
        frame.nearest = -depth;
    } else {
        frame.originX = right;
        frame.originY = up;
        frame.nearest = -2.0; // the box reaches one radius either way
    }
    const auto box = boxIndex(drawn);
    frame.boxLow = (box.low + 0.5) / glm::dvec3(grid.dims) - wrappedShift(window);
    frame.boxHigh = (box.high + 0.5) / glm::dvec3(grid.dims) - wrappedShift(window);
    return frame;
}

void setRayUniforms(const gpu::Program& program, const RayFrame& frame, glm::ivec2 sizePixels) {
    program.set("pictureOfPixel",
                glm::vec4(2.0 * frame.pictureHalf / glm::dvec2(sizePixels), -frame.pictureHalf));
    program.set("rayOrigin", glm::vec3(frame.origin));
    program.set("rayOriginX", glm::vec3(frame.originX));
    program.set("rayOriginY", glm::vec3(frame.originY));
    program.set("rayDirection", glm::vec3(frame.direction));
    program.set("rayDirectionX", glm::vec3(frame.directionX));
    program.set("rayDirectionY", glm::vec3(frame.directionY));
    program.set("rayNearest", static_cast<float>(frame.nearest));
    program.set("rayLengthPerspective", frame.perspective ? 1.0F : 0.0F);
    program.set("boxLow", glm::vec3(frame.boxLow));
    program.set("boxHigh", glm::vec3(frame.boxHigh));
}

glm::dvec3 voxelsPerDepth(const RayFrame& frame, const glm::ivec3& levelDims, const glm::dvec2& q) {
    return (frame.direction + q.x * frame.directionX + q.y * frame.directionY) * glm::dvec3(levelDims);
}

} // namespace voxsheet
