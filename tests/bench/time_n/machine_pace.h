// How fast the machine is while a time-N curve is measured. A virtual machine is slower for seconds or
// minutes while its neighbours are busy, by a third and more; points that are measured one after the other
// then lie on curves of different machines.
#pragma once

#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/pace_curve.h"
#include "bench/time_n/time_n_scene.h"
#include "frame/render_thread.h"

#include <memory>

namespace voxsheet::bench {

/// Draws one tile of the scene at level 0 now and then, apart from all that is measured: with a render thread
/// and textures of its own.
class MachinePace {
public:
    /// Measures the pace that others are compared with. Throws as RenderThread, GpuError when the tile fails.
    MachinePace(const TimeNScene& scene, const BenchDatasets& datasets,
                std::shared_ptr<const VolumeProvider> volumes, int device);

    /// Between two frames; draws at most every 30 ms.
    void look();
    void forget() { looks_.clear(); } ///< the looks so far
    /// Above 1 when the machine was slower around that time than at first. There must have been a look.
    [[nodiscard]] double slowdownAt(PaceCurve::Clock::time_point time) const {
        return looks_.msAt(time) / firstMs_;
    }

private:
    [[nodiscard]] double drawnMs();

    TileSpec tile_;
    RenderThread thread_;
    PaceCurve looks_;
    double firstMs_ = 0.0;
};

} // namespace voxsheet::bench
