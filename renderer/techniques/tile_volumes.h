// The resident textures that one tile is drawn from.
#pragma once

#include "residency/residency_manager.h"
#include "stages/tile_spec.h"

#include <optional>

namespace voxsheet {

/// Leases: none of them is evicted while this lives.
struct TileVolumes {
    VolumeLease volume;
    std::optional<VolumeLease> gradients;  ///< shading from a gradient texture
    std::optional<VolumeLease> clipObject; ///< its distances
    std::optional<VolumeLease> colours;    ///< of isosurfaces coloured by another volume

    [[nodiscard]] double uploadMs() const;
    [[nodiscard]] double readMs() const;
};

} // namespace voxsheet
