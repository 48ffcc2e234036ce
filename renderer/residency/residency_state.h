// Counters of what is resident on the GPU.
#pragma once

#include <cstdint>

namespace voxsheet {

struct ResidencyState {
    std::uint64_t residentBytes = 0;
    std::uint64_t budgetBytes = 0;
    int textures = 0;
    std::uint64_t uploadedBytes = 0; ///< since the start
    std::uint64_t evictions = 0;     ///< since the start
};

} // namespace voxsheet
