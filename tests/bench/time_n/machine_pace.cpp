#include "bench/time_n/machine_pace.h"

#include "base/errors.h"
#include "bench/time_n/stop_signals.h"
#include "resolution/measured_median.h"

#include <utility>
#include <vector>

namespace voxsheet::bench {

namespace {

constexpr int kWarmUps = 5;
constexpr int kFirstLooks = 40;
constexpr std::chrono::milliseconds kEvery{30};

} // namespace

MachinePace::MachinePace(const TimeNScene& scene, const BenchDatasets& datasets,
                         std::shared_ptr<const VolumeProvider> volumes, int device)
    : tile_(timeNTile(scene, datasets.key(0), datasets.grid(), 0, 0)),
      thread_(std::move(volumes), {device, 0}) {
    for (int i = 0; i < kWarmUps; ++i)
        (void)drawnMs();
    std::vector<double> times;
    for (int i = 0; i < kFirstLooks; ++i)
        times.push_back(drawnMs());
    firstMs_ = measuredMedian(times).value;
}

double MachinePace::drawnMs() {
    FrameSpec frame;
    frame.tiles = {tile_};
    const auto drawn = thread_.submit(std::move(frame), FramePriority::Export, &stopRequested).get();
    if (!drawn.tiles.front().error.empty()) throw GpuError("time-N bench", drawn.tiles.front().error);
    return drawn.wallMs;
}

void MachinePace::look() {
    if (!looks_.isDue(PaceCurve::Clock::now(), kEvery)) return;
    const double ms = drawnMs();
    looks_.add(PaceCurve::Clock::now(), ms);
}

} // namespace voxsheet::bench
