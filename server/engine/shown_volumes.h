// What all pages look at together: the volumes that stay on the GPU longest.
#pragma once

#include "residency/wanted_volume.h"
#include "stages/tile_spec.h"
#include "techniques/render_paths.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// Every volume that the tile reads.
[[nodiscard]] std::vector<WantedVolume> volumesOf(const TileSpec& tile, const RenderPaths& paths,
                                                  WantedPriority priority);

/// Not thread-safe.
class ShownVolumes {
public:
    /// Replaces what one viewer shows (empty: it is gone). Returns what all show, each volume once with the
    /// highest priority that it has anywhere; nothing if that did not change.
    [[nodiscard]] std::optional<std::vector<WantedVolume>> replace(const std::string& viewer,
                                                                   std::vector<WantedVolume> volumes);

private:
    std::map<std::string, std::vector<WantedVolume>> viewers_;
    std::vector<WantedVolume> all_;
};

} // namespace voxsheet::engine
