#include "bench/time_n/time_n_bench.h"

#include "base/byte_size.h"
#include "base/errors.h"
#include "base/host_memory.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/measured_sheet.h"
#include "bench/time_n/n_steps.h"
#include "bench/time_n/other_load.h"
#include "bench/time_n/second_look.h"
#include "bench/time_n/stop_signals.h"
#include "frame/render_thread.h"
#include "residency/host_volume_cache.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace voxsheet::bench {

namespace {

class TimeNRun {
public:
    TimeNRun(const TimeNOptions& options, const BenchDatasets& datasets,
             const std::function<void(const std::string&)>& progress)
        : datasets_(datasets), progress_(progress), sheet_(options, datasets),
          resolution_(options.rule, levelCount(datasets.grid().dims)) {
        result_.options = options;
        result_.renderer = sheet_.renderer();
        result_.onDisk = datasets.onDisk();
    }

    [[nodiscard]] TimeNResult run() {
        growN();
        for (int visit = 1; visit < result_.options.visits; ++visit)
            visitAgain(visit);
        if (isOff()) judge();
        result_.otherLoad = load_.share();
        result_.segments = segmentsOf(result_.points);
        result_.textureSwapN = firstN(&TimeNPoint::movesTextures);
        result_.memorySwapN = firstN(&TimeNPoint::readsDisk);
        result_.timerGpuMs = sheet_.timers().gpuMs();
        result_.timerHostMs = sheet_.timers().hostMs();
        result_.timersAgree = sheet_.timers().agrees();
        if (result_.nMax == 0) result_.nMax = result_.points.back().n;
        return std::move(result_);
    }

private:
    /// The N that is measured after n.
    [[nodiscard]] int next(int n) const { return nextN(n, result_.options.step, result_.options.maxN); }
    [[nodiscard]] bool isOff() const { return result_.options.rule.criterion == ResolutionCriterion::Off; }

    /// The first visit of each N, and what the rule says to it.
    void growN() {
        for (int n = 1; n <= result_.options.maxN; n = next(n)) {
            measureAndKeep(n);
            if (const auto first = firstNToMeasureAgain(n)) {
                n = startAgainFrom(*first);
                continue;
            }
            while (!isOff() && answer(n)) {
            }
            const double limit = result_.options.stopMs;
            if (limit > 0.0 && result_.points.back().ms.value > limit) break;
        }
    }

    void measureAndKeep(int n) {
        TimeNPoint point;
        point.n = n;
        point.level = resolution_.level();
        const auto& times = times_[n] = sheet_.visit(n, point.level, 0);
        for (const double ms : times.ms)
            resolution_.addFrame(n, ms);
        setTimes(point, times);
        setRatios(point, resolution_.times().curve(point.level, n));
        sheet_.checkTimers(n, point.level);
        result_.points.push_back(point);
        tell(point, 0);
    }

    /// There and back, so that a machine that becomes slower does not bend the curve.
    void visitAgain(int visit) {
        const std::size_t count = result_.points.size();
        for (std::size_t i = 0; i < count; ++i) {
            auto& point = result_.points[visit % 2 == 1 ? count - 1 - i : i];
            auto& times = times_[point.n];
            times.add(sheet_.visit(point.n, point.level, visit));
            setTimes(point, times);
            tell(point, visit);
        }
    }

    void tell(const TimeNPoint& point, int visit) const {
        char line[160];
        std::snprintf(line, sizeof line, "N = %d, level %d: %.1f ms (upload %.1f, reading %.1f)", point.n,
                      point.level, point.ms.value, point.uploadMs, point.ioMs);
        progress_(line + (visit > 0 ? ", visited " + std::to_string(visit + 1) + " times" : std::string()));
    }

    void setRatios(TimeNPoint& point, const std::vector<TimePoint>& curve) const {
        point.rawRatio = rawSlopeRatio(curve);
        point.ratio = newestSlopeRatio(segmentFrom(curve, std::max(watchedFromN_, watch_.segmentFirstN())));
    }

    /// Finds the bends of a curve that no level answers to, from all visits.
    void judge() {
        std::vector<TimePoint> curve;
        for (auto& point : result_.points) {
            curve.push_back({point.n, point.ms});
            setRatios(point, curve);
            if (const auto bend = watch_.judge(segmentFrom(curve, watchedFromN_), ratioLimit()))
                keepTransition(*bend, point.level, {});
        }
    }

    /// The first N of any whose resting frames do that.
    [[nodiscard]] std::optional<int> firstN(bool TimeNPoint::*does) const {
        std::optional<int> first;
        for (const auto* points : {&result_.points, &result_.trials})
            for (const auto& point : *points)
                if (point.*does) first = std::min(point.n, first.value_or(point.n));
        return first;
    }

    /// When the curve breaks the rule, and that may be the machine's doing: where its segment begins.
    [[nodiscard]] std::optional<int> firstNToMeasureAgain(int n) {
        const auto criterion = result_.options.rule.criterion;
        if (criterion != ResolutionCriterion::Slope && criterion != ResolutionCriterion::SlopeFirst)
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
        if (began(firstN(&TimeNPoint::readsDisk)))
            transition.cause = "memory budget";
        else if (began(firstN(&TimeNPoint::movesTextures)))
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
    MeasuredSheet sheet_;
    DynamicResolution resolution_;
    SecondLook look_;                 ///< at the segment that is being measured
    SlopeWatch watch_;                ///< finds the bends also when the rule is another one, or off
    int watchedFromN_ = 0;            ///< the last bend that broke the rule unanswered
    std::map<int, SheetTimes> times_; ///< of result_.points, by N
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
    inRange(options.visits, 1, 100, "--visits");
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
