#include "bench/time_n/measured_sheet.h"

#include "base/errors.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/stop_signals.h"
#include "residency/host_volume_cache.h"
#include "resolution/measured_median.h"
#include "store/store_volume_provider.h"

#include <algorithm>
#include <utility>

namespace voxsheet::bench {

namespace {

constexpr int kCheckedTiles = 4;
constexpr std::size_t kMostRounds = 32; ///< of a visit
/// Of all visits of one N: the quicker the frames, the more there are, for they are noisier.
constexpr double kLeastTotalMs = 4000.0;
constexpr int kFirstFrames = 5; ///< until shaders are compiled and clocks are up

void append(std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

} // namespace

void SheetTimes::add(const SheetTimes& visit) {
    append(ms, visit.ms);
    append(wallMs, visit.wallMs);
    append(slowdowns, visit.slowdowns);
    append(uploadMs, visit.uploadMs);
    append(readMs, visit.readMs);
    residentBytes = std::max(residentBytes, visit.residentBytes);
    hostBytes = std::max(hostBytes, visit.hostBytes);
    diskBytes += visit.diskBytes;
    movesTextures = movesTextures && visit.movesTextures;
    readsDisk = readsDisk && visit.readsDisk;
}

void setTimes(TimeNPoint& point, const SheetTimes& times) {
    point.ms = measuredMedian(times.ms);
    point.wallMs = measuredMedian(times.wallMs).value;
    point.slowdown = measuredMedian(times.slowdowns).value;
    point.uploadMs = measuredMedian(times.uploadMs).value;
    point.ioMs = measuredMedian(times.readMs).value;
    point.residentBytes = times.residentBytes;
    point.hostBytes = times.hostBytes;
    point.diskBytesPerFrame = times.diskBytes / static_cast<std::uint64_t>(times.ms.size());
    point.movesTextures = times.movesTextures;
    point.readsDisk = times.readsDisk;
}

std::shared_ptr<const HostVolumeCache> hostMemory(const BenchDatasets& datasets, std::uint64_t budgetBytes) {
    HostCacheOptions options;
    options.budgetBytes = budgetBytes;
    options.pageCache = PageCacheUse::DropAlways;
    return std::make_shared<const HostVolumeCache>(
        std::make_shared<const store::StoreVolumeProvider>(datasets.store()), options);
}

MeasuredSheet::MeasuredSheet(const TimeNOptions& options, const BenchDatasets& datasets)
    : scene_(options.scene), framesPerRound_(static_cast<std::size_t>(options.frames)),
      leastMs_(kLeastTotalMs / options.visits), datasets_(datasets),
      memory_(hostMemory(datasets, options.memoryBudgetBytes)),
      thread_(memory_, {options.device, options.textureBudgetBytes}),
      pace_(options.scene, datasets, std::make_shared<const store::StoreVolumeProvider>(datasets.store()),
            options.device) {
    for (int frame = 0; frame < kFirstFrames; ++frame)
        (void)draw(frameSpec(1, 0, frame));
}

MeasuredSheet::~MeasuredSheet() = default;

FrameSpec MeasuredSheet::frameSpec(int n, int level, int frame) const {
    FrameSpec spec;
    for (int index = 0; index < n; ++index)
        spec.tiles.push_back(timeNTile(scene_, datasets_.key(index), datasets_.grid(), level, frame));
    return spec;
}

FrameResult MeasuredSheet::draw(FrameSpec spec) {
    auto frame = thread_.submit(std::move(spec), FramePriority::Export, &stopRequested).get();
    for (const auto& tile : frame.tiles)
        if (!tile.error.empty()) throw GpuError("time-N bench", tile.error);
    return frame;
}

SheetTimes MeasuredSheet::visit(int n, int level, int number) {
    const std::size_t firstFrame = static_cast<std::size_t>(number) * framesPerRound_;
    (void)draw(frameSpec(n, level, static_cast<int>(firstFrame)));
    SheetTimes times;
    std::vector<PaceCurve::Clock::time_point> middles;
    const auto diskBytes = memory_->state().diskBytes;
    const auto evictions = thread_.residency().evictions;
    double totalMs = 0.0;
    // Whole rounds, so that every N is seen from the same sides.
    const auto isEnough = [&] {
        const std::size_t count = times.wallMs.size();
        return count >= kMostRounds * framesPerRound_ ||
               (totalMs >= leastMs_ && count % framesPerRound_ == 0);
    };
    pace_.forget();
    while (times.wallMs.empty() || !isEnough()) {
        pace_.look();
        const auto frame = firstFrame + times.wallMs.size() % framesPerRound_;
        const auto begun = PaceCurve::Clock::now();
        const auto drawn = draw(frameSpec(n, level, static_cast<int>(frame)));
        middles.push_back(begun + (PaceCurve::Clock::now() - begun) / 2);
        totalMs += times.wallMs.emplace_back(drawn.wallMs);
        double uploadMs = 0.0;
        double readMs = 0.0;
        for (const auto& tile : drawn.tiles) {
            uploadMs += tile.uploadMs;
            readMs += tile.readMs;
        }
        times.uploadMs.push_back(uploadMs);
        times.readMs.push_back(readMs);
        times.residentBytes = std::max(times.residentBytes, thread_.residency().residentBytes);
        times.hostBytes = std::max(times.hostBytes, memory_->state().bytes);
    }
    pace_.look();
    times.diskBytes = memory_->state().diskBytes - diskBytes;
    times.readsDisk = times.diskBytes > 0;
    times.movesTextures = thread_.residency().evictions > evictions;
    setToFirstPace(times, middles);
    return times;
}

/// What was waited for a disk stays as it was: only processors are slower for a while.
void MeasuredSheet::setToFirstPace(SheetTimes& times,
                                   const std::vector<PaceCurve::Clock::time_point>& middles) const {
    for (std::size_t i = 0; i < middles.size(); ++i) {
        const double slowdown = pace_.slowdownAt(middles[i]);
        const double readMs = std::min(times.readMs[i], times.wallMs[i]);
        times.slowdowns.push_back(slowdown);
        times.ms.push_back(readMs + (times.wallMs[i] - readMs) / slowdown);
    }
}

void MeasuredSheet::checkTimers(int n, int level) {
    auto spec = frameSpec(std::min(n, kCheckedTiles), level, 0);
    spec.checkTimers = true;
    timers_.add(draw(std::move(spec)));
}

} // namespace voxsheet::bench
