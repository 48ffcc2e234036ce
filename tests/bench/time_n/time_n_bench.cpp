#include "bench/time_n/time_n_bench.h"

#include "base/byte_size.h"
#include "base/errors.h"
#include "base/host_memory.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/machine_pace.h"
#include "bench/time_n/n_steps.h"
#include "bench/time_n/other_load.h"
#include "bench/time_n/second_look.h"
#include "bench/time_n/stop_signals.h"
#include "frame/render_thread.h"
#include "frame/timer_check.h"
#include "residency/host_volume_cache.h"
#include "store/store_volume_provider.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace voxsheet::bench {

namespace {

constexpr int kCheckedTiles = 4;
constexpr std::size_t kMostRounds = 16;
constexpr double kLeastTotalMs = 1200.0;
constexpr int kFirstFrames = 5; ///< until shaders are compiled and clocks are up

/// What it does not keep comes from the disk: nothing is left to the system's page cache.
std::shared_ptr<const HostVolumeCache> hostMemory(const BenchDatasets& datasets, std::uint64_t budgetBytes) {
    HostCacheOptions options;
    options.budgetBytes = budgetBytes;
    options.pageCache = PageCacheUse::DropAlways;
    return std::make_shared<const HostVolumeCache>(
        std::make_shared<const store::StoreVolumeProvider>(datasets.store()), options);
}

class TimeNRun {
public:
    TimeNRun(const TimeNOptions& options, const BenchDatasets& datasets,
             const std::function<void(const std::string&)>& progress)
        : datasets_(datasets), progress_(progress), memory_(hostMemory(datasets, options.memoryBudgetBytes)),
          thread_(memory_, {options.device, options.textureBudgetBytes}),
          pace_(options.scene, datasets, std::make_shared<const store::StoreVolumeProvider>(datasets.store()),
                options.device),
          resolution_(options.rule, levelCount(datasets.grid().dims)) {
        result_.options = options;
        result_.renderer = thread_.device().renderer;
        result_.onDisk = datasets.onDisk();
    }

    [[nodiscard]] TimeNResult run() {
        for (int frame = 0; frame < kFirstFrames; ++frame)
            (void)draw(frameSpec(1, frame));
        for (int n = 1; n <= result_.options.maxN; n = next(n)) {
            measureAndKeep(n);
            if (const auto first = firstNToMeasureAgain(n)) {
                n = startAgainFrom(*first);
                continue;
            }
            while (answer(n)) {
            }
            const double limit = result_.options.stopMs;
            if (limit > 0.0 && result_.points.back().ms.value > limit) break;
        }
        result_.otherLoad = load_.share();
        result_.segments = segmentsOf(result_.points);
        result_.timerGpuMs = timers_.gpuMs();
        result_.timerHostMs = timers_.hostMs();
        result_.timersAgree = timers_.agrees();
        if (result_.nMax == 0) result_.nMax = result_.points.back().n;
        return std::move(result_);
    }

private:
    /// The N that is measured after n.
    [[nodiscard]] int next(int n) const { return nextN(n, result_.options.step, result_.options.maxN); }

    [[nodiscard]] FrameSpec frameSpec(int n, int frame) const {
        FrameSpec spec;
        for (int index = 0; index < n; ++index)
            spec.tiles.push_back(timeNTile(result_.options.scene, datasets_.key(index), datasets_.grid(),
                                           resolution_.level(), frame));
        return spec;
    }

    [[nodiscard]] FrameResult draw(FrameSpec spec) {
        auto frame = thread_.submit(std::move(spec), FramePriority::Export, &stopRequested).get();
        for (const auto& tile : frame.tiles)
            if (!tile.error.empty()) throw GpuError("time-N bench", tile.error);
        return frame;
    }

    void measureAndKeep(int n) {
        const auto point = measure(n);
        result_.points.push_back(point);
        char line[160];
        std::snprintf(line, sizeof line, "N = %d, level %d: %.1f ms (upload %.1f, reading %.1f)", n,
                      point.level, point.ms.value, point.uploadMs, point.ioMs);
        progress_(line);
    }

    /// Of the frames of one N.
    struct Frames {
        std::vector<double> wallMs;
        std::vector<double> uploadMs; ///< sums over tiles
        std::vector<double> readMs;   ///< likewise
        std::vector<PaceCurve::Clock::time_point> middles;
    };

    [[nodiscard]] TimeNPoint measure(int n) {
        (void)draw(frameSpec(n, 0)); // uploads what is new
        TimeNPoint point;
        point.n = n;
        point.level = resolution_.level();
        const auto diskBefore = memory_->state().diskBytes;
        const Frames frames = drawRounds(point);
        point.wallMs = measuredMedian(frames.wallMs).value;
        point.uploadMs = measuredMedian(frames.uploadMs).value;
        point.ioMs = measuredMedian(frames.readMs).value;
        point.diskBytesPerFrame =
            (memory_->state().diskBytes - diskBefore) / static_cast<std::uint64_t>(frames.wallMs.size());
        if (point.uploadMs > 0.0 && !result_.textureSwapN) result_.textureSwapN = n;
        if (point.diskBytesPerFrame > 0 && !result_.memorySwapN) result_.memorySwapN = n;
        keepAtFirstPace(frames, point);
        const auto curve = resolution_.times().curve(point.level, n);
        point.rawRatio = rawSlopeRatio(curve);
        point.ratio = newestSlopeRatio(segmentFrom(curve, std::max(watchedFromN_, watch_.segmentFirstN())));
        checkTimers(n);
        return point;
    }

    [[nodiscard]] Frames drawRounds(TimeNPoint& point) {
        Frames frames;
        double totalMs = 0.0;
        // Whole rounds, so that every N is seen from the same sides.
        const auto round = static_cast<std::size_t>(result_.options.frames);
        const auto isEnough = [&] {
            const std::size_t count = frames.wallMs.size();
            return count >= kMostRounds * round || (totalMs >= kLeastTotalMs && count % round == 0);
        };
        pace_.forget();
        while (frames.wallMs.empty() || !isEnough()) {
            pace_.look();
            const auto begun = PaceCurve::Clock::now();
            const auto drawn = draw(frameSpec(point.n, static_cast<int>(frames.wallMs.size() % round)));
            frames.middles.push_back(begun + (PaceCurve::Clock::now() - begun) / 2);
            frames.wallMs.push_back(drawn.wallMs);
            totalMs += drawn.wallMs;
            double uploadMs = 0.0;
            double readMs = 0.0;
            for (const auto& tile : drawn.tiles) {
                uploadMs += tile.uploadMs;
                readMs += tile.readMs;
            }
            frames.uploadMs.push_back(uploadMs);
            frames.readMs.push_back(readMs);
            point.residentBytes = std::max(point.residentBytes, thread_.residency().residentBytes);
            point.hostBytes = std::max(point.hostBytes, memory_->state().bytes);
        }
        pace_.look();
        return frames;
    }

    /// What was waited for a disk stays as it was: only processors are slower for a while.
    void keepAtFirstPace(const Frames& frames, TimeNPoint& point) {
        std::vector<double> slowdowns;
        std::vector<double> times;
        for (std::size_t i = 0; i < frames.wallMs.size(); ++i) {
            slowdowns.push_back(pace_.slowdownAt(frames.middles[i]));
            const double readMs = std::min(frames.readMs[i], frames.wallMs[i]);
            times.push_back(readMs + (frames.wallMs[i] - readMs) / slowdowns.back());
            resolution_.addFrame(point.n, times.back());
        }
        point.slowdown = measuredMedian(slowdowns).value;
        point.ms = measuredMedian(times);
    }

    void checkTimers(int n) {
        auto spec = frameSpec(std::min(n, kCheckedTiles), 0);
        spec.checkTimers = true;
        timers_.add(draw(std::move(spec)));
    }

    /// When the curve breaks the rule, and that may be the machine's doing: where its segment begins.
    [[nodiscard]] std::optional<int> firstNToMeasureAgain(int n) {
        const auto criterion = result_.options.rule.criterion;
        if (criterion != ResolutionCriterion::Off && criterion != ResolutionCriterion::Slope &&
            criterion != ResolutionCriterion::SlopeFirst)
            return std::nullopt;
        const auto curve = resolution_.times().curve(resolution_.level(), n);
        auto watch = watch_; // a question: the answer is answer()'s
        const auto bend = watch.judge(segmentFrom(curve, watchedFromN_), ratioLimit());
        if (!bend || !bend->breaksRule || !look_.wantsAnother(bend->lastN, next(bend->lastN) - bend->lastN))
            return std::nullopt;
        progress_("the slope grew after N = " + std::to_string(bend->lastN) +
                  ": measured again, for the machine may have been slower for a while");
        return segmentFrom(curve, watchedFromN_).front().n;
    }

    /// Forgets the curve from firstN on. Returns the last N before.
    int startAgainFrom(int firstN) {
        const auto first = std::find_if(result_.points.begin(), result_.points.end(),
                                        [&](const TimeNPoint& point) { return point.n >= firstN; });
        const int before = first == result_.points.begin() ? 0 : std::prev(first)->n;
        result_.earlierPasses.insert(result_.earlierPasses.end(), first, result_.points.end());
        result_.points.erase(first, result_.points.end());
        resolution_.forgetTimes();
        watch_ = {};
        return before;
    }

    /// Asks the rule about the sheet of n datasets, and follows it. Returns whether there is a new level, and
    /// n was measured at it.
    bool answer(int n) {
        const int level = resolution_.level();
        const auto curve = resolution_.times().curve(level, n);
        const auto bend = watch_.judge(segmentFrom(curve, watchedFromN_), ratioLimit());
        const auto decision = resolution_.decide({n, bytesAtLevelZero(n)});
        if (bend) keepTransition(*bend, level, decision);
        if (!decision.changed) return false;
        progress_(decision.reason);
        watch_ = {};
        look_ = {};
        watchedFromN_ = 0;
        const auto lastN = resolution_.lastNOfLevel()[static_cast<std::size_t>(level)];
        const int firstN = decision.level > level && lastN ? *lastN + 1 : n;
        measureAgainFrom(firstN);
        return true;
    }

    /// The sheets of firstN datasets and more are drawn at another level from now on.
    void measureAgainFrom(int firstN) {
        const auto first = std::find_if(result_.points.begin(), result_.points.end(),
                                        [&](const TimeNPoint& point) { return point.n >= firstN; });
        const std::vector<TimeNPoint> again(first, result_.points.end());
        result_.points.erase(first, result_.points.end());
        result_.trials.insert(result_.trials.end(), again.begin(), again.end());
        for (const auto& point : again)
            measureAndKeep(point.n);
    }

    void keepTransition(const SlopeBend& bend, int level, const Decision& decision) {
        TimeNTransition transition{bend, level, "unknown", {}};
        const auto began = [&](const std::optional<int>& n) {
            return n && *n >= bend.lastN - 1 && *n <= bend.detectedN;
        };
        if (began(result_.memorySwapN))
            transition.cause = "memory budget";
        else if (began(result_.textureSwapN))
            transition.cause = "texture budget";
        if (decision.changed) transition.newLevel = decision.level;
        if (bend.breaksRule && !decision.changed && result_.nMax == 0) result_.nMax = bend.lastN;
        result_.transitions.push_back(transition);
        if (!bend.breaksRule) return;
        watch_ = {};
        look_ = {};
        watchedFromN_ = bend.lastN;
    }

    [[nodiscard]] double ratioLimit() const {
        return result_.options.rule.criterion == ResolutionCriterion::SlopeFirst ? kFirstTransitionRatioLimit
                                                                                 : kPaperRatioLimit;
    }

    [[nodiscard]] std::uint64_t bytesAtLevelZero(int n) const {
        const auto voxels = static_cast<std::uint64_t>(sampleCount(datasets_.grid().dims));
        return static_cast<std::uint64_t>(n) * voxels;
    }

    const BenchDatasets& datasets_;
    const std::function<void(const std::string&)>& progress_;
    std::shared_ptr<const HostVolumeCache> memory_;
    RenderThread thread_;
    MachinePace pace_;
    DynamicResolution resolution_;
    SecondLook look_;      ///< at the segment that is being measured
    SlopeWatch watch_;     ///< finds the bends also when the rule is another one, or off
    int watchedFromN_ = 0; ///< the last bend that broke the rule unanswered
    TimerCheck timers_;
    OtherLoad load_;
    TimeNResult result_;
};

} // namespace

void validateOptions(const TimeNOptions& options) {
    const auto inRange = [](int value, int low, int high, const char* option) {
        if (value < low || value > high)
            throw InvalidInput(option,
                               "it must be from " + std::to_string(low) + " to " + std::to_string(high))
                .withField(option);
    };
    inRange(options.maxN, 1, 1024, "--max-n");
    inRange(options.dim, 16, 1024, "--dim");
    inRange(options.frames, 1, 1000, "--frames");
    inRange(options.step, 1, 1024, "--step");
    const auto budget = [](std::uint64_t bytes, const char* option) {
        if (bytes == 0)
            throw InvalidInput(option, "it must be above 0 bytes", "give for example 256M").withField(option);
    };
    budget(options.textureBudgetBytes, "--texture-budget");
    budget(options.memoryBudgetBytes, "--memory-budget");
    if (options.memoryBudgetBytes > hostMemoryBytes())
        throw InvalidInput("--memory-budget",
                           byteText(options.memoryBudgetBytes) + " is more than the " +
                               byteText(hostMemoryBytes()) + " of this machine",
                           "give at most that")
            .withField("--memory-budget");
    if (!std::isfinite(options.stopMs) || options.stopMs < 0.0)
        throw InvalidInput("--stop-ms", "it must be 0 or more milliseconds",
                           "leave it out to go on to --max-n")
            .withField("--stop-ms");
}

void rehearse(const TimeNOptions& options, const BenchDatasets& datasets) {
    validateOptions(options);
    RenderThread thread(hostMemory(datasets, options.memoryBudgetBytes),
                        {options.device, options.textureBudgetBytes});
    FrameSpec frame;
    frame.tiles = {timeNTile(options.scene, datasets.key(0), datasets.grid(), 0, 0)};
    const auto drawn = thread.submit(std::move(frame), FramePriority::Export, &stopRequested).get();
    const auto& tile = drawn.tiles.front();
    if (tile.error.empty()) return;
    if (tile.errorKind != ErrorKind::LimitExceeded) throw GpuError("time-N bench", tile.error);
    throw InvalidInput("--texture-budget",
                       "one dataset of " + std::to_string(options.dim) + "³ voxels at full resolution (" +
                           options.scene.technique + (options.scene.shading ? ", shading" : "") +
                           ") does not fit: " + tile.error,
                       "give more, or a smaller --dim")
        .withField("--texture-budget");
}

TimeNResult timeNBench(const TimeNOptions& options, const BenchDatasets& datasets,
                       const std::function<void(const std::string&)>& progress) {
    validateOptions(options);
    return TimeNRun(options, datasets, progress).run();
}

} // namespace voxsheet::bench
