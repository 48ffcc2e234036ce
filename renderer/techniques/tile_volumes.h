// The resident textures that one tile is drawn from.
#pragma once

#include "residency/residency_manager.h"
#include "stages/tile_spec.h"

#include <optional>
#include <vector>

namespace voxsheet {

/// Levels of detail of the volumes that a tile is drawn from.
struct TileLevels {
    int volume = 0;
    int clipObject = 0;
    int colours = 0;
    std::vector<int> layers; ///< as many as the tile has

    bool operator==(const TileLevels&) const = default;
};

/// Leases: none of them is evicted while this lives.
struct TileVolumes {
    VolumeLease volume;
    std::optional<VolumeLease> gradients;  ///< shading from a gradient texture
    std::optional<VolumeLease> clipObject; ///< its distances
    std::optional<VolumeLease> colours;    ///< of isosurfaces coloured by another volume
    std::vector<VolumeLease> layers;       ///< of TileSpec::layers, in their order
    bool standIn = false; ///< something is drawn from another level, or without its gradient texture
    bool awaited = false; ///< what the stand-in stands for is being brought in

    [[nodiscard]] double uploadMs() const;
    [[nodiscard]] double readMs() const;
};

} // namespace voxsheet
