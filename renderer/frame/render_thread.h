// The one owner of the GL context: takes FrameSpecs, gives pixels.
#pragma once

#include "frame/frame_spec.h"
#include "volume/volume_provider.h"

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet {

struct RenderDevice {
    std::string renderer;     ///< GL_RENDERER
    std::string vendor;       ///< GL_VENDOR
    std::string version;      ///< GL_VERSION
    std::string eglPlatform;  ///< "device 0 (…)", "surfaceless Mesa"
    std::string reason;       ///< why this one was chosen, one sentence
    bool software = false;    ///< llvmpipe, softpipe, swrast
    bool robust = false;      ///< a context with reset notification
    std::uint64_t textureBudgetBytes = 0;
    int maxTextureSize3d = 0;
};

struct RenderOptions {
    int device = -1;                      ///< --device; -1 = choose
    std::uint64_t textureBudgetBytes = 0; ///< 0 = a stated share of the device's memory (llvmpipe: of RAM)
};

struct ResidencyState {
    std::uint64_t residentBytes = 0;
    std::uint64_t budgetBytes = 0;
    int textures = 0;
    std::uint64_t uploadedBytes = 0; ///< since the start
    std::uint64_t evictions = 0;     ///< since the start
};

enum class FramePriority { Interactive, Final, Export };

/// Thread-safe. Frames of higher priority are drawn first, those of one priority in order of submission. A frame that
/// fails as a whole (device lost) throws GpuError from its future; a tile that fails sets TilePixels::error.
class RenderThread {
  public:
    /// Throws GpuError if no usable EGL is there (the text names the package to install).
    RenderThread(std::shared_ptr<const VolumeProvider> volumes, const RenderOptions& options);
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    [[nodiscard]] const RenderDevice& device() const;
    /// `cancelled` is asked before each tile; when true, the future throws Cancelled.
    [[nodiscard]] std::future<FrameResult> submit(FrameSpec frame, FramePriority priority,
                                                  std::function<bool()> cancelled = {});
    [[nodiscard]] ResidencyState residency() const;
    /// Drops every texture of a dataset (it was removed or replaced).
    void forget(const std::string& dataset);

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// EGL devices of this machine, for `--device` and `GET /api/v1`; one line each.
[[nodiscard]] std::vector<std::string> listRenderDevices();

} // namespace voxsheet
