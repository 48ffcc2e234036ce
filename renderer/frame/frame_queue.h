// Frames that wait for the render thread, and the order in which their tiles are drawn. No GL.
#pragma once

#include "frame/render_thread.h"
#include "techniques/tile_volumes.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace voxsheet {

/// One submitted frame. Everything but `promise` and `cancelled` at submission belongs to the render thread.
struct FrameJob {
    FrameSpec frame;
    FramePriority priority = FramePriority::Interactive;
    std::function<bool()> cancelled;
    std::promise<FrameResult> promise;

    FrameResult result;
    std::vector<bool> issued;                      ///< per tile: drawing has been queued
    std::vector<std::optional<TileLevels>> levels; ///< per tile, once it has been looked at
    std::vector<std::optional<bool>> atHand;       ///< per tile, once it was looked at: its samples are
    std::optional<std::size_t> ahead;              ///< the tile that the disk reads for, or did last
    std::size_t issuedCount = 0;
    std::size_t finishedCount = 0; ///< tiles with pixels or an error, and absent ones
    bool waitedForAbsent = false;  ///< a tile was left out after some waiting: the others wait no more
    bool settled = false;          ///< the promise has its value or exception
    std::optional<std::chrono::steady_clock::time_point> begun;
    std::chrono::steady_clock::duration broughtIn{}; ///< spent between its tiles on what it does not wait for

    void fail(std::exception_ptr error); ///< does nothing when settled
    void succeedIfFinished();            ///< sets the value once every tile has finished
};

/// Thread-safe.
class FrameQueue {
public:
    void push(std::shared_ptr<FrameJob> job);
    /// A command for the render thread, run before the next tile.
    void pushCommand(std::function<void()> command);
    /// No more work is taken: all that waits is handed out by takeRemaining().
    void stop();

    struct Work {
        std::vector<std::function<void()>> commands;
        std::shared_ptr<FrameJob>
            job; ///< highest priority, then first submitted; stays queued until removed; or null
        bool stopping = false;
    };
    /// \param wait  sleep until there is something in Work
    [[nodiscard]] Work next(bool wait);
    void remove(const std::shared_ptr<FrameJob>& job);
    [[nodiscard]] std::vector<std::shared_ptr<FrameJob>> takeRemaining();

private:
    [[nodiscard]] std::shared_ptr<FrameJob> best() const;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::shared_ptr<FrameJob>> jobs_; ///< in order of submission
    std::vector<std::function<void()>> commands_;
    bool stopping_ = false;
};

} // namespace voxsheet
