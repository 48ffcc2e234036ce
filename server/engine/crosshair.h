// The point that planes beside a volume have in common, and its lines on a picture.
#pragma once

#include "sheet/typed_style.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace voxsheet::engine {

/// plane.crosshair in the world of a volume; not set: there is none. \param drawn  the drawn grid
[[nodiscard]] std::optional<glm::dvec3> crosshairWorld(const sheet::PlaneStyle& plane, const Grid& drawn);

/// Pixels from the picture's top left corner.
struct PixelLine {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
};

/// Where a point of the world is seen; not set: behind the eye.
[[nodiscard]] std::optional<glm::dvec2> pixelAt(const CameraSpec& camera, const glm::dvec3& world,
                                                glm::ivec2 sizePixels);

/// On a plane: across the picture and from top to bottom, with a gap about the point. Otherwise three lines
/// through the drawn box along the world's axes.
[[nodiscard]] std::vector<PixelLine> crosshairLines(const TileSpec& tile, const Grid& drawn,
                                                    const glm::dvec3& crosshair);

} // namespace voxsheet::engine
