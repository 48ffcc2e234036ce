// What the importer process does to itself before it looks at a file.
#pragma once

#include <cstdint>
#include <sys/types.h>

namespace voxsheet::import {

struct ProcessLimits {
    std::uint64_t memoryBytes = 0; ///< of voxels and work on them; 0 = no limit
    std::uint64_t cpuSeconds = 0;  ///< 0 = no limit
    pid_t parent = 0;              ///< this process ends with it; 0 = it lives on its own
};

/// Address space that the program itself, its libraries and its threads' stacks and heaps take up, used or
/// not.
inline constexpr std::uint64_t kProgramAddressSpace = 1ULL << 30;

/// No core dumps, limits on address space and processor time, first in line when the system runs out of
/// memory, and the parent's end is this process's end. Ends the process when the parent is gone already.
/// Under AddressSanitizer, whose shadow needs terabytes of address space, the address space stays without
/// limit.
void applyProcessLimits(const ProcessLimits& limits);

/// Moves standard output to a private descriptor and points the old one at standard error, so that nothing a
/// library prints can be taken for an answer. Returns the private descriptor.
[[nodiscard]] int takeStandardOutput();

} // namespace voxsheet::import
