// Which GPU (or software renderer) draws, and why it was chosen. Plain data: no GL header is needed to read
// it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet {

struct RenderDevice {
    std::string renderer;          ///< GL_RENDERER
    std::string vendor;            ///< GL_VENDOR
    std::string version;           ///< GL_VERSION
    std::string eglPlatform;       ///< "device 0 (…)", "surfaceless Mesa"
    std::string reason;            ///< why this one was chosen, one sentence
    bool software = false;         ///< llvmpipe, softpipe, swrast
    bool robust = false;           ///< a context with reset notification
    std::uint64_t memoryBytes = 0; ///< that textures can take at most; 0 when the driver does not tell
    std::uint64_t textureBudgetBytes = 0;
    std::string textureBudgetReason; ///< "a quarter of this machine's memory", "as asked for"
    int maxTextureSize3d = 0;
    std::vector<std::string> workarounds; ///< names of the driver workarounds in force
};

/// EGL devices of this machine, for `--device` and `GET /api/v1`; one line each. Empty when there is no EGL.
[[nodiscard]] std::vector<std::string> listRenderDevices();

} // namespace voxsheet
