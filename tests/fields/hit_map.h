// What the rays of a picture meet: positions and normals, and which pixels lie at silhouettes.
#pragma once

#include "fields/inside.h"

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet::fields {

/// Of every pixel what its ray meets, front to back; row by row from the bottom.
using PixelHits = std::vector<std::vector<IsoHit>>;

/// shownHits() of every pixel.
[[nodiscard]] PixelHits isosurfaceHits(const TileSpec& tile, const Sources& sources);
/// faceHit() of every pixel, `surface` 0 for all.
[[nodiscard]] PixelHits faceHits(const TileSpec& tile, const Sources& sources);

/// True for pixels within one pixel of where hits come and go, or jump by more than `jump` in depth.
[[nodiscard]] std::vector<bool> silhouettes(const PixelHits& hits, const glm::ivec2& size, double jump);

struct FirstHit {
    int surface = -1;         ///< of tile.isosurface.surfaces; -1: nothing is met (position and normal are 0)
    glm::dvec3 position{0.0}; ///< world
    glm::dvec3 normal{0.0};   ///< world, unit length, turned to the eye; 0 where there is no gradient
};

/// The first root that each pixel's ray meets, caps not counted.
[[nodiscard]] std::vector<FirstHit> firstHits(const TileSpec& tile, const Sources& sources);

} // namespace voxsheet::fields
