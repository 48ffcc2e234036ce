// One tile from spec to host pixels, in two halves so that the next tile is drawn while this one is copied
// back.
#pragma once

#include "frame/band_pace.h"
#include "frame/frame_spec.h"
#include "frame/target_pool.h"
#include "frame/tile_resolver.h"
#include "gpu/context.h"
#include "gpu/pixel_readback.h"
#include "gpu/timer_query.h"
#include "residency/residency_manager.h"
#include "techniques/technique_set.h"
#include "techniques/tile_acquisition.h"

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace voxsheet {

/// What copies a tile back from the device.
struct ReadbackSlot {
    gpu::TimerQuery timer;
    gpu::Buffer packed;
    gpu::PixelReadback readback;
};

/// A tile that is being drawn and copied back.
struct TileInFlight {
    std::unique_ptr<ReadbackSlot> slot; ///< null: drawn in host memory
    std::vector<float> onHost;          ///< of those: rgba, row 0 at the bottom
    TilePixels pixels;                  ///< all but the pixels and the render time
    PixelFormat format = PixelFormat::Rgba8;
    std::size_t bytes = 0;
    std::chrono::steady_clock::time_point begun;
    std::optional<gpu::Texture> target; ///< its own, while it is drawn in bands on the device
    int nextRow = 0;                    ///< that is still to be drawn
    double bandsMs = 0.0;               ///< spent on the bands so far
    bool inBands = false;

    [[nodiscard]] bool isDrawn() const { return nextRow >= pixels.size.y; }
};

/// Whether a tile that takes long is drawn in bands of rows, with other tiles in between.
enum class TileBreaks { None, BetweenBands };

/// Everything that lives on the GPU. Belongs to the thread that made it.
class TileRenderer {
public:
    /// \param textureBudgetBytes  0 = the device's default
    TileRenderer(std::shared_ptr<const VolumeProvider> volumes, int device, std::uint64_t textureBudgetBytes);

    [[nodiscard]] const RenderDevice& device() const { return device_; }
    [[nodiscard]] ResidencyManager& residency() { return residency_; }
    [[nodiscard]] const gpu::Workarounds& workarounds() const { return context_.workarounds(); }
    void setPaths(const RenderPaths& paths) { techniques_.setPaths(paths); } ///< before the first tile

    /// The levels to draw from. Throws as levelsWithinBudget.
    [[nodiscard]] TileLevels levelsFor(const TileSpec& tile, LevelChoice choice) const;
    [[nodiscard]] bool isResident(const TileSpec& tile, const TileLevels& levels) const;
    /// What has to be read before the tile can be drawn.
    [[nodiscard]] std::vector<WantedVolume> missing(const TileSpec& tile, const TileLevels& levels) const;
    /// Works until the deadline on what the tile needs; the tile itself is not drawn. Throws as begin.
    void bringIn(const TileSpec& tile, const TileLevels& levels, Deadline deadline);
    /// Makes the volumes resident, or finds what is at hand of them, and queues drawing, resolving and
    /// readback. Null when the deadline came first: to be called again. Throws what the tile is at fault for.
    [[nodiscard]] std::unique_ptr<TileInFlight> begin(const TileSpec& tile, const FrameSpec& frame,
                                                      const TileLevels& levels, Deadline deadline,
                                                      TileBreaks breaks = TileBreaks::None);
    /// Draws the next band of a tile that is not drawn; `spec`, `frame` and `levels` as given to begin. May
    /// do nothing but bring in volumes that were evicted meanwhile, until the deadline. Throws as begin.
    void resume(TileInFlight& tile, const TileSpec& spec, const FrameSpec& frame, const TileLevels& levels,
                Deadline deadline);
    /// Waits for the pixels. Throws GpuError.
    [[nodiscard]] TilePixels finish(std::unique_ptr<TileInFlight> tile);
    /// Throws GpuError when the GPU was reset.
    void checkReset() const { context_.checkReset(); }

private:
    [[nodiscard]] std::optional<TileVolumes> acquire(const TileSpec& tile, LevelChoice choice,
                                                     const TileLevels& levels, Deadline deadline);
    [[nodiscard]] std::unique_ptr<ReadbackSlot> takeSlot(std::size_t bytes);
    void resolveOnHost(TileInFlight& tile, const glm::vec4& background);
    void drawBand(TileInFlight& tile, const TileSpec& spec, const TileVolumes& volumes);
    [[nodiscard]] double plausibleRenderMs(double gpuMs, double wallMs);

    gpu::Context context_;
    RenderDevice device_;
    ResidencyManager residency_;
    TechniqueSet techniques_;
    TileResolver resolver_;
    TargetPool targets_;
    BandPace pace_;
    std::vector<std::unique_ptr<ReadbackSlot>> slots_; ///< idle ones
    std::vector<float> spare_;                         ///< memory of the last picture drawn on the host
    bool warnedOfTimer_ = false;
};

} // namespace voxsheet
