// Where an isosurface is and which way it faces, told by colours: techniques hand out nothing else.
#pragma once

#include "fields/hit_map.h"
#include "image/tile_painter.h"

#include <vector>

namespace voxsheet::image {

/// Resolution of measured positions: what they can be off by, in world units.
[[nodiscard]] double measuredPositionError(const Grid& grid);

/// Of each pixel the position that the tile's surface shows: the surface is coloured by volumes that hold x,
/// y and z of the world, window by window. `surface` is 0 where something is seen; normals are left 0. Adds
/// those volumes to the painter.
[[nodiscard]] std::vector<fields::FirstHit> measuredPositions(TilePainter& painter, TileSpec tile);

/// Of each pixel the unit normal of what the tile shows, in the world: the diffuse light of one directional
/// light along each half axis. Gradients as tile.shading.gradient says; positions are left 0.
[[nodiscard]] std::vector<fields::FirstHit> measuredNormals(TilePainter& painter, TileSpec tile);

} // namespace voxsheet::image
