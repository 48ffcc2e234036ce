// What a picture is computed from in double precision: the drawn volume and the volumes that clip and colour
// it.
#pragma once

#include "fields/solids.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"
#include "volume/volume_provider.h"

#include <glm/glm.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace voxsheet::fields {

/// Value at a texture coordinate; NaN = absent. Must be safe to call from several threads.
using ValueAt = std::function<double(const glm::dvec3& texture)>;

/// Derivatives of the value along the axes of the level's index frame, per voxel of the level, at a texture
/// coordinate. Must be safe to call from several threads.
using GradientAt = std::function<glm::dvec3(const glm::dvec3& texture)>;

struct ClipSource {
    Grid grid;             ///< of the object, in its own world
    glm::ivec3 dims{1};    ///< of its level
    ValueAt distance;      ///< what decides: negative inside
    GradientAt indexSlope; ///< of the distance; empty: the object's surface has no normal
};

struct ColourSource {
    Grid grid;
    ValueAt value;
};

struct LayerSource {
    Grid grid;
    glm::ivec3 levelDims{1};
    ValueAt value;         ///< of categories that of the nearest sample
    GradientAt indexSlope; ///< by six taps
};

struct Sources {
    Grid grid;             ///< of the drawn volume
    glm::ivec3 levelDims;  ///< of the drawn level
    ValueAt value;         ///< for isosurfaces: trilinear between the level's samples
    GradientAt indexSlope; ///< empty: only cuts are shaded
    double valueRange =
        0.0; ///< largest value less smallest, of the whole volume (IsosurfaceMethod::AlphaTest)
    std::optional<ClipSource> clip;     ///< for tile.clip.object
    std::optional<ColourSource> colour; ///< for tile.isosurface.colouredBy
    std::vector<LayerSource> layers;    ///< for tile.layers, in their order
    ValueAt nearest;                    ///< of the nearest sample: for planes
    std::vector<Capsule> solids;        ///< atoms and bonds
};

/// Everything that `tile` names, read through the provider: trilinear interpolants of the stored samples, and
/// gradients as tile.shading.gradient asks for. Throws what the provider throws.
[[nodiscard]] Sources sourcesOf(const VolumeProvider& volumes, const TileSpec& tile);

} // namespace voxsheet::fields
