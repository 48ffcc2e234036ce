// One level of a volume, whole and ready for rays that the processor marches.
#pragma once

#include "volume/host_texels.h"
#include "volume/min_max_grid.h"

#include <cstdint>
#include <memory>

namespace voxsheet {

/// Neither is null.
struct HostLevel {
    std::shared_ptr<const HostTexels> texels;
    std::shared_ptr<const MinMaxGrid> minMax; ///< in values
    std::uint64_t rangesHash = 0;             ///< contentHash(*minMax)
};

/// One of which slices [0, slices) are set.
struct UnfinishedLevel {
    std::shared_ptr<HostTexels> texels; ///< not null
    int slices = 0;
};

[[nodiscard]] inline std::uint64_t bytesOf(const HostLevel& level) {
    return HostTexels::bytesFor(level.texels->format(), level.texels->dims()) +
           level.minMax->ranges.size() * sizeof(MinMaxGrid::Range);
}

} // namespace voxsheet
