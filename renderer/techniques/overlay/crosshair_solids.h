// The crosshair of linked planes in the picture of a volume, as lines at their depth.
#pragma once

#include "techniques/overlay/crystal_solids.h"

namespace voxsheet {

/// Three lines through TileSpec::crosshairWorld, each from side to side of the drawn box; none where it is
/// not set, and none with Technique::Plane.
[[nodiscard]] std::vector<Solid> crosshairSolids(const Grid& grid, const TileSpec& tile);

} // namespace voxsheet
