// Which atom of a crystal is seen under a pixel.
#pragma once

#include "engine/kept_ray.h"
#include "stages/tile_spec.h"
#include "volume/crystal_sites.h"

#include <optional>

namespace voxsheet::engine {

struct AtomHit {
    int atomicNumber = 0;
    glm::dvec3 centreWorld{0.0};
    double depth = 0.0; ///< along the ray, of the sphere; of technique plane, of the plane
};

/// The first sphere that the ray meets of those that the tile shows (CrystalSpec; an atom whose centre a clip
/// plane or the clip object removes is not shown). With technique plane: the disc that the plane cuts.
/// \param sites   of the tile's dataset and periods
/// \param object  not null if tile.clip.object is set
[[nodiscard]] std::optional<AtomHit> atomUnderRay(const TileSpec& tile, const CrystalSites& sites,
                                                  const Ray& ray, const ObjectSamples* object);

} // namespace voxsheet::engine
