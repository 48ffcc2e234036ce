#include "base/host_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace voxsheet {

std::uint64_t hostMemoryBytes() {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long pageBytes = sysconf(_SC_PAGESIZE);
    std::uint64_t bytes = pages > 0 && pageBytes > 0
                              ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes)
                              : std::uint64_t{4} << 30;
    // The file says "max" when there is no limit.
    std::ifstream limitFile("/sys/fs/cgroup/memory.max");
    std::uint64_t limit = 0;
    if (limitFile >> limit && limit > 0) bytes = std::min(bytes, limit);
    return bytes;
}

} // namespace voxsheet
