#include "frame/render_thread.h"

#include "base/errors.h"
#include "base/log.h"
#include "frame/frame_order.h"
#include "frame/frame_queue.h"
#include "frame/tile_renderer.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <thread>
#include <utility>

namespace voxsheet {

namespace {

/// Tiles drawn but not copied back: one is mapped while the next is drawn.
constexpr std::size_t kTilesInFlight = 1;

/// Bringing textures in stops after about this time to see what else is to be done.
constexpr auto kSlice = std::chrono::milliseconds(4);

/// A frame that waits for nothing gives so much of its time, or kSlice if that is more, to bringing things
/// in.
constexpr double kShareForBringingIn = 0.25;

Deadline sliceEnd() { return std::chrono::steady_clock::now() + kSlice; }

/// The device is gone, and with it every texture and program.
struct DeviceLost {
    std::exception_ptr error;
    std::shared_ptr<FrameJob> job; ///< the frame during which it was noticed
};

} // namespace

class RenderThread::Implementation {
public:
    Implementation(std::shared_ptr<const VolumeProvider> volumes, const RenderOptions& options)
        : volumes_(std::move(volumes)), options_(options) {
        std::promise<RenderDevice> started;
        auto device = started.get_future();
        thread_ = std::thread([this, started = std::move(started)]() mutable { run(std::move(started)); });
        try {
            device_ = device.get();
        } catch (...) {
            thread_.join();
            throw;
        }
    }

    ~Implementation() {
        queue_.stop();
        thread_.join();
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    [[nodiscard]] const RenderDevice& device() const { return device_; }
    [[nodiscard]] const std::vector<PathChoice>& paths() const { return paths_; }

    [[nodiscard]] ResidencyState residency() const {
        const std::scoped_lock lock(stateMutex_);
        return state_;
    }

    [[nodiscard]] std::future<FrameResult> submit(FrameSpec frame, FramePriority priority,
                                                  std::function<bool()> cancelled) {
        auto job = std::make_shared<FrameJob>();
        job->result.tiles.resize(frame.tiles.size());
        job->issued.resize(frame.tiles.size());
        job->levels.resize(frame.tiles.size());
        job->atHand.resize(frame.tiles.size());
        job->frame = std::move(frame);
        job->priority = priority;
        job->cancelled = std::move(cancelled);
        auto result = job->promise.get_future();
        queue_.push(std::move(job));
        return result;
    }

    void forget(std::string dataset) {
        queue_.pushCommand([this, dataset = std::move(dataset)] {
            if (!renderer_) return; // lost: nothing is resident
            renderer_->residency().forget(dataset);
            publishState();
        });
    }

    void setWanted(std::vector<WantedVolume> wanted) {
        queue_.pushCommand([this, wanted = std::move(wanted)]() mutable {
            wanted_ = std::move(wanted);
            if (!renderer_) return;
            renderer_->residency().setWanted(wanted_);
            publishState();
        });
    }

private:
    struct InFlight {
        std::shared_ptr<FrameJob> job;
        std::size_t tile;
        std::unique_ptr<TileInFlight> drawing;
    };

    void run(std::promise<RenderDevice> started) {
        try {
            startRenderer();
        } catch (...) {
            renderer_.reset(); // on its own thread
            started.set_exception(std::current_exception());
            return;
        }
        started.set_value(renderer_->device());
        while (workOnce()) {
        }
        for (const auto& job : queue_.takeRemaining()) {
            job->fail(std::make_exception_ptr(Cancelled("the frame", "the renderer is shutting down")));
        }
        inFlight_.clear();
        partlyDrawn_.clear();
        renderer_.reset();
    }

    /// Returns false when the thread is to end.
    bool workOnce() {
        const bool idle = inFlight_.empty() && (!renderer_ || renderer_->residency().isIdle());
        const FrameQueue::Work work = queue_.next(idle);
        for (const auto& command : work.commands)
            command();
        try {
            if (work.job) {
                // What is more urgent is handed out before anything less urgent is begun.
                while (!inFlight_.empty() && inFlight_.front().job->priority < work.job->priority)
                    finishOldest();
                advance(work.job);
                while (inFlight_.size() > kTilesInFlight)
                    finishOldest();
            } else if (!inFlight_.empty()) {
                finishOldest();
            } else if (renderer_ && !work.stopping) {
                renderer_->residency().advance(sliceEnd());
                publishState();
            }
        } catch (const DeviceLost& lost) {
            giveUpDevice(lost);
        }
        return !(work.stopping && inFlight_.empty());
    }

    void startRenderer() {
        renderer_ = std::make_unique<TileRenderer>(volumes_, options_.device, options_.textureBudgetBytes);
        order_.emplace(*renderer_);
        if (paths_.empty()) paths_ = choosePaths();
        renderer_->setPaths(pathsOf(paths_));
        renderer_->residency().setWanted(wanted_);
        publishState();
    }

    [[nodiscard]] std::vector<PathChoice> choosePaths() const {
        if (options_.choosePaths) return options_.choosePaths(renderer_->device());
        return voxsheet::choosePaths(pathsByRule(renderer_->workarounds()), {}, {});
    }

    void publishState() {
        const ResidencyState now = renderer_ ? renderer_->residency().state() : ResidencyState{};
        if (now.evictions > 0 && options_.onFirstEviction) std::exchange(options_.onFirstEviction, {})();
        published_ = std::chrono::steady_clock::now();
        const std::scoped_lock lock(stateMutex_);
        state_ = now;
    }

    /// Counting all textures takes as long as drawing a small tile: not after each of many.
    void publishAfterTile(const FrameJob& job) {
        const bool last = job.issuedCount == job.frame.tiles.size();
        if (last || std::chrono::steady_clock::now() - published_ >= kSlice) publishState();
    }

    /// Draws the job's next tile, or ends the job.
    void advance(const std::shared_ptr<FrameJob>& job) {
        if (!job->begun) job->begun = std::chrono::steady_clock::now();
        if (job->settled || isCancelled(*job)) {
            job->fail(std::make_exception_ptr(Cancelled("the frame", "it is no longer wanted")));
            queue_.remove(job);
            std::erase_if(partlyDrawn_, [&](const InFlight& each) { return each.job == job; });
            return;
        }
        if (!renderer_) restartRenderer(job);
        const bool alone = job->frame.checkTimers;
        while (alone && !inFlight_.empty())
            finishOldest();
        const auto partly = std::find_if(partlyDrawn_.begin(), partlyDrawn_.end(),
                                         [&](const InFlight& each) { return each.job == job; });
        if (partly != partlyDrawn_.end()) {
            InFlight drawing = std::move(*partly);
            partlyDrawn_.erase(partly);
            resumeTile(std::move(drawing));
        } else if (job->issuedCount < job->frame.tiles.size()) {
            beginTile(job, order_->next(job));
        }
        while (alone && !inFlight_.empty())
            finishOldest();
        if (job->issuedCount == job->frame.tiles.size()) {
            queue_.remove(job);
            job->succeedIfFinished();
        }
    }

    static bool isCancelled(FrameJob& job) {
        try {
            return job.cancelled && job.cancelled();
        } catch (...) {
            job.fail(std::current_exception());
            return true;
        }
    }

    /// Draws the tile, or brings in some of what it needs.
    void beginTile(const std::shared_ptr<FrameJob>& job, std::size_t tile) {
        try {
            const bool atHand = job->frame.levels == LevelChoice::AtHand;
            const Deadline deadline = job->waitedForAbsent ? std::chrono::steady_clock::now() : sliceEnd();
            auto drawing = renderer_->begin(job->frame.tiles[tile], job->frame,
                                            levelsOf(*renderer_, *job, tile), deadline, breaksOf(*job));
            if (!drawing && atHand) {
                leaveOut(*job, tile);
            } else if (!drawing) {
                waiting_ = {job, tile};
                publishState();
                if (!inFlight_.empty()) finishOldest();
                return;
            } else {
                keepDrawing({job, tile, std::move(drawing)});
            }
        } catch (const DeviceLost&) {
            throw;
        } catch (...) {
            markIssued(*job, tile);
            failTile(job, tile);
        }
        if (job->frame.levels == LevelChoice::AtHand && !job->frame.checkTimers) bringInBetween(*job);
        publishAfterTile(*job);
    }

    /// Nothing of it is there to be drawn, nor was within a slice of time: one wait per frame.
    static void leaveOut(FrameJob& job, std::size_t tile) {
        TilePixels& pixels = job.result.tiles[tile];
        pixels.size = job.frame.tiles[tile].sizePixels;
        pixels.level = job.frame.tiles[tile].level;
        pixels.absent = pixels.awaited = true;
        job.waitedForAbsent = true;
        markIssued(job, tile);
        ++job.finishedCount;
    }

    /// What nothing is more urgent than, and what is timed, is drawn at one stretch.
    static TileBreaks breaksOf(const FrameJob& job) {
        const bool urgent = job.priority == FramePriority::Interactive;
        return urgent || job.frame.checkTimers ? TileBreaks::None : TileBreaks::BetweenBands;
    }

    /// Draws the tile's next band.
    void resumeTile(InFlight drawing) {
        const auto job = drawing.job;
        const auto tile = drawing.tile;
        try {
            renderer_->resume(*drawing.drawing, job->frame.tiles[tile], job->frame,
                              levelsOf(*renderer_, *job, tile), sliceEnd());
            keepDrawing(std::move(drawing));
        } catch (...) {
            markIssued(*job, tile);
            failTile(job, tile);
        }
        publishState();
    }

    void keepDrawing(InFlight drawing) {
        if (!drawing.drawing->isDrawn()) {
            partlyDrawn_.push_back(std::move(drawing));
            return;
        }
        markIssued(*drawing.job, drawing.tile);
        inFlight_.push_back(std::move(drawing));
    }

    static void markIssued(FrameJob& job, std::size_t tile) {
        job.issued[tile] = true;
        ++job.issuedCount;
    }

    /// Between two tiles that wait for nothing: what another frame waits for, else the background's queue.
    void bringInBetween(FrameJob& drawn) {
        const auto begun = std::chrono::steady_clock::now();
        if (drawn.broughtIn >=
            std::max<std::chrono::duration<double>>(kSlice, kShareForBringingIn * (begun - *drawn.begun)))
            return;
        bringInSomething();
        drawn.broughtIn += std::chrono::steady_clock::now() - begun;
    }

    void bringInSomething() {
        const auto job = waiting_.job.lock();
        if (!job || job->settled || job->issued[waiting_.tile]) {
            renderer_->residency().advance(sliceEnd());
            return;
        }
        try {
            renderer_->bringIn(job->frame.tiles[waiting_.tile], levelsOf(*renderer_, *job, waiting_.tile),
                               sliceEnd());
        } catch (const std::exception&) {
            waiting_ = {}; // The tile itself meets the same error, and keeps it.
        }
    }

    void finishOldest() {
        InFlight oldest = std::move(inFlight_.front());
        inFlight_.pop_front();
        try {
            oldest.job->result.tiles[oldest.tile] = renderer_->finish(std::move(oldest.drawing));
            ++oldest.job->finishedCount;
        } catch (...) {
            failTile(oldest.job, oldest.tile);
        }
        if (oldest.job->finishedCount == oldest.job->frame.tiles.size()) throwIfLost(oldest.job);
        oldest.job->succeedIfFinished();
    }

    /// Called in a catch block: keeps the error with the tile, unless the device is lost.
    void failTile(const std::shared_ptr<FrameJob>& job, std::size_t tile) {
        TilePixels& pixels = job->result.tiles[tile];
        pixels = {};
        pixels.size = job->frame.tiles[tile].sizePixels;
        pixels.level = job->frame.tiles[tile].level;
        ++job->finishedCount;
        try {
            throw;
        } catch (const Error& error) {
            pixels.error = error.what();
            pixels.errorKind = error.kind();
        } catch (const std::bad_alloc&) {
            pixels.error =
                "the tile: the machine has no memory left; draw a coarser level or a smaller picture";
            pixels.errorKind = ErrorKind::LimitExceeded;
        } catch (const std::exception& error) {
            pixels.error = std::string("the tile: ") + error.what();
        }
        throwIfLost(job);
    }

    void throwIfLost(const std::shared_ptr<FrameJob>& job) {
        try {
            renderer_->checkReset();
        } catch (const GpuError&) {
            throw DeviceLost{std::current_exception(), job};
        }
    }

    /// Fails the frames that were being drawn. The next frame starts afresh, on a new context.
    void giveUpDevice(const DeviceLost& lost) {
        try {
            std::rethrow_exception(lost.error);
        } catch (const std::exception& error) {
            logError(error.what());
        }
        lost.job->fail(lost.error);
        queue_.remove(lost.job);
        for (const InFlight& drawing : inFlight_) {
            drawing.job->fail(lost.error);
            queue_.remove(drawing.job);
        }
        inFlight_.clear();
        partlyDrawn_.clear();
        renderer_.reset();
        publishState();
    }

    void restartRenderer(const std::shared_ptr<FrameJob>& job) {
        try {
            startRenderer();
        } catch (...) {
            renderer_.reset();
            throw DeviceLost{std::current_exception(), job};
        }
    }

    std::shared_ptr<const VolumeProvider> volumes_;
    RenderOptions options_;
    RenderDevice device_;
    std::chrono::steady_clock::time_point published_; ///< when state_ was told last
    std::vector<PathChoice> paths_;                   ///< settled before the constructor returns
    FrameQueue queue_;
    mutable std::mutex stateMutex_;
    ResidencyState state_;

    // Of the render thread alone.
    std::unique_ptr<TileRenderer> renderer_; ///< null after the device was lost
    std::optional<FrameOrder> order_;        ///< of renderer_'s tiles
    std::vector<WantedVolume> wanted_;
    struct Waiting {
        std::weak_ptr<FrameJob> job;
        std::size_t tile = 0;
    };
    Waiting waiting_; ///< the tile whose volumes were being brought in last
    std::deque<InFlight> inFlight_;
    std::vector<InFlight> partlyDrawn_; ///< of waiting jobs, at most one each

    std::thread thread_;
};

RenderThread::RenderThread(std::shared_ptr<const VolumeProvider> volumes, const RenderOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(volumes), options)) {}

RenderThread::~RenderThread() = default;

const RenderDevice& RenderThread::device() const { return implementation_->device(); }

const std::vector<PathChoice>& RenderThread::paths() const { return implementation_->paths(); }

std::future<FrameResult> RenderThread::submit(FrameSpec frame, FramePriority priority,
                                              std::function<bool()> cancelled) {
    return implementation_->submit(std::move(frame), priority, std::move(cancelled));
}

ResidencyState RenderThread::residency() const { return implementation_->residency(); }

void RenderThread::setWanted(std::vector<WantedVolume> wanted) {
    implementation_->setWanted(std::move(wanted));
}

void RenderThread::forget(const std::string& dataset) { implementation_->forget(dataset); }

} // namespace voxsheet
