#include "techniques/overlay/crosshair_solids.h"

#include "volume/box_extent.h"

namespace voxsheet {

namespace {

constexpr glm::vec4 kCrosshairColour(1.0F, 0.84F, 0.2F, 0.0F); // as on planes: engine/sheet_image.cpp
constexpr float kCrosshairLine = 2.0F;                         // Solid::end

} // namespace

std::vector<Solid> crosshairSolids(const Grid& grid, const TileSpec& tile) {
    std::vector<Solid> solids;
    if (!tile.crosshairWorld || tile.technique == Technique::Plane) return solids;
    const Grid drawn = drawnGrid(grid, tile.periodic);
    const auto centre = centreWorld(drawn);
    const double unit = boundingRadiusWorld(drawn);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        const Extent extent = extentAlong(direction, drawn);
        auto low = *tile.crosshairWorld;
        auto high = low;
        low[axis] = extent.low;
        high[axis] = extent.high;
        solids.push_back({glm::vec4((low - centre) / unit, 0.0),
                          glm::vec4((high - centre) / unit, kCrosshairLine), kCrosshairColour,
                          kCrosshairColour});
    }
    return solids;
}

} // namespace voxsheet
