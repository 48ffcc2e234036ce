// Atoms, bonds and cells of a crystal as capsules: all points within a radius of a line segment, which has
// no length for atoms.
#pragma once

#include "stages/crystal_spec.h"
#include "stages/tile_spec.h"

#include <vector>

namespace voxsheet {

/// As the shaders read it; lengths in bounding radii of the drawn box, from its centre on, world axes.
struct Solid {
    glm::vec4 start;       ///< w: radius; 0: a line, whose width the picture decides
    glm::vec4 end;         ///< w: 1 a line, 2 a line of the crosshair, which is thicker and never clipped
    glm::vec4 startColour; ///< rgb, of the half next to the start; w: how far beyond a clip that end still
                           ///< counts as kept
    glm::vec4 endColour;
};

/// What TileSpec::crystal shows of the crystal. Throws as crystalSites.
[[nodiscard]] std::vector<Solid> crystalSolids(const Crystal& crystal, const Grid& grid,
                                               const TileSpec& tile);

} // namespace voxsheet
