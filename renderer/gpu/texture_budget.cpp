#include "gpu/texture_budget.h"

#include "base/host_memory.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace voxsheet::gpu {

namespace {

constexpr std::uint64_t kKiB = 1024;
constexpr std::uint64_t kFallbackBytes = kKiB * kKiB * kKiB;

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

TextureMemory textureMemory(bool software) {
    if (software) {
        const std::uint64_t bytes = hostMemoryBytes();
        return {bytes, bytes / 4, "a quarter of this machine's memory"};
    }
    const std::uint64_t bytes = gpuMemoryKiB() * kKiB;
    if (bytes == 0) return {0, kFallbackBytes, "1 GiB: the driver does not tell the device's memory"};
    return {bytes, bytes / 10 * 6, "six tenths of the device's memory"};
}

} // namespace voxsheet::gpu
