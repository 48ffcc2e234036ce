// What the time-N bench draws: the four techniques of Khanduja & Karki 2007, figures 6 to 8.
#pragma once

#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <string>

namespace voxsheet::bench {

struct TimeNScene {
    std::string technique = "vr"; ///< "vr" volume rendering (ray casting), "sr" surface rendering of the box
                                  ///< and a cut plane, "vc" volume rendering inside of a clip object (voxels
                                  ///< of a sphere), "ie" isosurface extraction
    bool shading = false;         ///< Phong, with a gradient texture beside each volume as in the paper
    glm::ivec2 tilePixels{256};
};

/// A tile of one dataset (all lie on one grid) in the view of a frame: the camera turns by two degrees each.
/// Throws InvalidInput for an unknown technique.
[[nodiscard]] TileSpec timeNTile(const TimeNScene& scene, const std::string& dataset, const Grid& grid,
                                 int level, int frame);

} // namespace voxsheet::bench
