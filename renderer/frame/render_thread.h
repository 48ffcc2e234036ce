// The one owner of the GL context: takes FrameSpecs, gives pixels.
#pragma once

#include "frame/frame_spec.h"
#include "frame/path_choice.h"
#include "gpu/render_device.h"
#include "residency/residency_state.h"
#include "residency/wanted_volume.h"
#include "volume/volume_provider.h"

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet {

struct RenderOptions {
    int device = -1;                      ///< --device; -1 = choose
    std::uint64_t textureBudgetBytes = 0; ///< 0 = a stated share of the device's memory (llvmpipe: of RAM)
    /// Called on the render thread when the budget first makes something go; must not block or throw.
    std::function<void()> onFirstEviction = {};
    /// Asked once, when the device is known, on the render thread; what it throws, the constructor does.
    /// Empty: by rule.
    std::function<std::vector<PathChoice>(const RenderDevice& device)> choosePaths = {};
};

enum class FramePriority { Interactive, Final, Export };

/// Thread-safe. Textures are brought in some milliseconds at a time, so that a frame of higher priority never
/// waits for a whole one. Frames of higher priority are drawn first, those of one priority in order of
/// submission. A frame that fails as a whole (device lost) throws GpuError from its future; a tile that fails
/// sets TilePixels::error. A frame of higher priority goes in between two tiles
/// of a lower one, and between bands of some 30 ms of a tile that takes longer. Frames still
/// waiting at destruction throw Cancelled.
class RenderThread {
public:
    /// Throws GpuError if no usable EGL is there (the text names the package to install), InvalidInput (with
    /// field --texture-budget) for a budget above the device's memory.
    RenderThread(std::shared_ptr<const VolumeProvider> volumes, const RenderOptions& options);
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    [[nodiscard]] const RenderDevice& device() const;
    [[nodiscard]] const std::vector<PathChoice>& paths() const; ///< of each technique
    /// `cancelled` is asked before each tile and while its volumes are brought in; when true, the future
    /// throws Cancelled.
    [[nodiscard]] std::future<FrameResult> submit(FrameSpec frame, FramePriority priority,
                                                  std::function<bool()> cancelled = {});
    /// Replaces what is looked at and what soon will be: evicted last, and brought in between the tiles of
    /// frames with LevelChoice::AtHand and while nothing is drawn. Returns at once.
    void setWanted(std::vector<WantedVolume> wanted);
    /// As of the last tile that was drawn, upload or dataset that was forgotten.
    [[nodiscard]] ResidencyState residency() const;
    /// Drops every texture of a dataset (it was removed or replaced). Returns at once; takes effect before
    /// the next tile.
    void forget(const std::string& dataset);

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace voxsheet
