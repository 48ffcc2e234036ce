// What lies under a pixel of a cell's picture.
#pragma once

#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace voxsheet::engine {

/// One level of a field, in memory.
struct LevelSamples {
    glm::ivec3 dims{1};
    glm::bvec3 periodic{false};
    std::vector<float> values; ///< x fastest

    /// Trilinear at a texture coordinate; NaN if one of the eight is NaN.
    [[nodiscard]] float at(const glm::dvec3& texture) const;
};

/// A ray of the world, `direction` of unit length.
struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};
};

/// Through the point `pixel` of a picture, (0, 0) its top left corner.
[[nodiscard]] Ray pixelRay(const CameraSpec& camera, glm::dvec2 pixel, glm::ivec2 sizePixels);

/// Where the ray is inside the drawn box: distances from its origin, not behind it. Empty if it misses.
struct RaySpan {
    double enter = 0.0;
    double leave = 0.0;
};
[[nodiscard]] std::optional<RaySpan> spanInBox(const Ray& ray, const Grid& grid);

/// The point that the eye sees: where the accumulated opacity passes one half; for maximum intensity
/// projection the largest value; if nothing along the ray is that opaque, the point nearest to the middle
/// of the box. Empty if the ray misses it.
[[nodiscard]] std::optional<glm::dvec3> pointUnderPixel(const TileSpec& tile, const Grid& grid,
                                                        const LevelSamples& level, glm::dvec2 pixel);

} // namespace voxsheet::engine
