// Counters of samples that are kept in host memory.
#pragma once

#include <cstdint>

namespace voxsheet {

struct HostCacheState {
    std::uint64_t bytes = 0; ///< kept now; never above the budget
    std::uint64_t budgetBytes = 0;
    // Since the start:
    std::uint64_t hits = 0;   ///< blocks found
    std::uint64_t misses = 0; ///< blocks that had to be read
    std::uint64_t evictions = 0;
    std::uint64_t diskBytes = 0; ///< read from the source
    double diskMs = 0.0;         ///< spent on it, summed over threads
};

} // namespace voxsheet
