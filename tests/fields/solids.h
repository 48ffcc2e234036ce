// Atoms and bonds that stand in a picture, in double precision. Written from the definitions in
// stages/crystal_spec.h and techniques/overlay/solids_overlay.h; shares no code with the shaders.
#pragma once

#include "fields/rays.h"
#include "stages/tile_spec.h"
#include "volume/dataset.h"

#include <functional>
#include <optional>
#include <vector>

namespace voxsheet::fields {

/// All points within the radius of a segment; world units.
struct Capsule {
    glm::dvec3 start{0.0};
    glm::dvec3 end{0.0};
    double radius = 0.0;
    glm::dvec3 startColour{0.0};
    glm::dvec3 endColour{0.0};
};

/// Of what tile.crystal shows but the edges of cells, as far as the tile's clips leave it.
/// \param objectMeasure  >= 0 where tile.clip.object keeps a point of the world, in its own units; empty:
/// there is none
[[nodiscard]] std::vector<Capsule> capsulesOf(const TileSpec& tile, const DatasetMeta& meta,
                                              const std::function<double(const glm::dvec3&)>& objectMeasure);

struct SolidHit {
    double depth = 0.0;
    glm::dvec3 normal{0.0}; ///< outward, of any length, world
    glm::dvec3 rgb{0.0};    ///< unlit
};

/// Where the ray first meets one, before the eye; of those around the eye the inside.
[[nodiscard]] std::optional<SolidHit>
firstSolidHit(const TileSpec& tile, const std::vector<Capsule>& capsules, const WorldRay& ray);

/// The capsule in which tile.plane meets the ray, of several the one whose axis is nearest in radii.
[[nodiscard]] std::optional<SolidHit> cutSolidHit(const TileSpec& tile, const std::vector<Capsule>& capsules,
                                                  const WorldRay& ray);

} // namespace voxsheet::fields
