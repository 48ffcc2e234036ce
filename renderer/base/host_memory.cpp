#include "base/host_memory.h"

#include "base/control_group.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace voxsheet {

namespace {

/// The files say "max" (version 2) or a number beyond any memory (version 1) where there is no limit.
std::uint64_t limitIn(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::uint64_t limit = 0;
    return in >> limit && limit > 0 ? limit : UINT64_MAX;
}

} // namespace

std::uint64_t hostMemoryBytes(const std::filesystem::path& root) {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long pageBytes = sysconf(_SC_PAGESIZE);
    std::uint64_t bytes = pages > 0 && pageBytes > 0
                              ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes)
                              : std::uint64_t{4} << 30;
    const auto groups = controlGroups("memory", root);
    for (const auto& folder : groups.unified)
        bytes = std::min(bytes, limitIn(folder / "memory.max"));
    for (const auto& folder : groups.controller)
        bytes = std::min(bytes, limitIn(folder / "memory.limit_in_bytes"));
    return bytes;
}

} // namespace voxsheet
