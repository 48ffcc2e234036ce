// Which of a frame's tiles is drawn next, and what the disk reads meanwhile.
#pragma once

#include "frame/frame_queue.h"
#include "frame/tile_order.h"
#include "frame/tile_renderer.h"

#include <cstddef>
#include <memory>

namespace voxsheet {

/// The levels that the tile is drawn from, looked up once. Throws as TileRenderer::levelsFor.
[[nodiscard]] const TileLevels& levelsOf(const TileRenderer& renderer, FrameJob& job, std::size_t tile);

/// Belongs to the render thread.
class FrameOrder {
public:
    /// \param renderer  outlives this
    explicit FrameOrder(TileRenderer& renderer);

    /// One that is not issued yet; there is one at least. As soon as nothing but host memory and the disk is
    /// left to draw from, the disk reads for one tile after another while those at hand are drawn; each comes
    /// next once it is read, so that its place is free for the one after it.
    [[nodiscard]] std::size_t next(const std::shared_ptr<FrameJob>& job);

private:
    [[nodiscard]] TileReadiness readiness(FrameJob& job, std::size_t tile) const;
    [[nodiscard]] bool isAtHand(FrameJob& job, std::size_t tile) const;
    void readAhead(const std::shared_ptr<FrameJob>& job, std::size_t tile);
    void awaitAllOf(FrameJob& job);

    TileRenderer& renderer_;
    std::weak_ptr<FrameJob> awaiting_; ///< the frame whose volumes are awaited
    bool areAwaited_ = false;          ///< of whatever frame
};

} // namespace voxsheet
