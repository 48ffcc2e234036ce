#include "gpu/texture_budget.h"

#include <epoxy/gl.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace voxsheet::gpu {

namespace {

constexpr std::uint64_t kKiB = 1024;
constexpr std::uint64_t kFallbackBytes = kKiB * kKiB * kKiB;

std::uint64_t hostMemoryBytes() {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long pageBytes = sysconf(_SC_PAGESIZE);
    std::uint64_t bytes = pages > 0 && pageBytes > 0
                              ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes)
                              : 4 * kFallbackBytes;
    // A container's limit, version 2 of control groups; the file says "max" when there is none.
    std::ifstream limitFile("/sys/fs/cgroup/memory.max");
    std::uint64_t limit = 0;
    if (limitFile >> limit && limit > 0) bytes = std::min(bytes, limit);
    return bytes;
}

/// GPU memory in KiB, 0 when the driver does not tell.
std::uint64_t gpuMemoryKiB() {
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) {
        GLint dedicatedKiB = 0;
        glGetIntegerv(GL_GPU_MEMORY_INFO_DEDICATED_VIDMEM_NVX, &dedicatedKiB);
        return static_cast<std::uint64_t>(std::max(dedicatedKiB, 0));
    }
    if (epoxy_has_gl_extension("GL_ATI_meminfo")) {
        std::array<GLint, 4> freeKiB{}; // total free, largest block, auxiliary free, largest auxiliary block
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, freeKiB.data());
        return static_cast<std::uint64_t>(std::max(freeKiB[0], 0));
    }
    return 0;
}

} // namespace

std::uint64_t defaultTextureBudget(bool software) {
    if (software) return hostMemoryBytes() / 4;
    const std::uint64_t bytes = gpuMemoryKiB() * kKiB;
    return bytes == 0 ? kFallbackBytes : bytes / 10 * 6;
}

} // namespace voxsheet::gpu
