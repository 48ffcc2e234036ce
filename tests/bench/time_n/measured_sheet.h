// The sheet of the time-N bench: draws N tiles and times them.
#pragma once

#include "bench/time_n/machine_pace.h"
#include "bench/time_n/time_n_result.h"
#include "frame/render_thread.h"
#include "frame/timer_check.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet {
class HostVolumeCache;
}

namespace voxsheet::bench {

/// Of all frames of one N at one level.
struct SheetTimes {
    std::vector<double> ms; ///< TimeNPoint::ms
    std::vector<double> wallMs;
    std::vector<double> slowdowns; ///< of the machine meanwhile
    std::vector<double> uploadMs;  ///< sums over tiles
    std::vector<double> readMs;    ///< likewise
    std::uint64_t residentBytes = 0;
    std::uint64_t hostBytes = 0;
    std::uint64_t diskBytes = 0;
    bool movesTextures = true; ///< at every visit
    bool readsDisk = true;     ///< likewise

    void add(const SheetTimes& visit);
};

/// What the times of a point become; its N, level and ratios stay.
void setTimes(TimeNPoint& point, const SheetTimes& times);

class MeasuredSheet {
public:
    /// Draws a few frames of one dataset, until shaders are compiled and clocks are up. Throws as timeNBench.
    MeasuredSheet(const TimeNOptions& options, const BenchDatasets& datasets);
    ~MeasuredSheet();
    MeasuredSheet(const MeasuredSheet&) = delete;
    MeasuredSheet& operator=(const MeasuredSheet&) = delete;

    /// A frame that does not count (it brings in what is new), then rounds of options.frames frames; each
    /// visit sees the tiles from other sides. Throws as timeNBench.
    /// \param number  of this visit of this N, from 0 on
    [[nodiscard]] SheetTimes visit(int n, int level, int number);
    /// Draws a few tiles with FrameSpec::checkTimers.
    void checkTimers(int n, int level);

    [[nodiscard]] const TimerCheck& timers() const { return timers_; }
    [[nodiscard]] const std::string& renderer() const { return thread_.device().renderer; }

private:
    [[nodiscard]] FrameSpec frameSpec(int n, int level, int frame) const;
    [[nodiscard]] FrameResult draw(FrameSpec spec);
    void setToFirstPace(SheetTimes& times, const std::vector<PaceCurve::Clock::time_point>& middles) const;

    TimeNScene scene_;
    std::size_t framesPerRound_;
    double leastMs_; ///< of a visit
    const BenchDatasets& datasets_;
    std::shared_ptr<const HostVolumeCache> memory_;
    RenderThread thread_;
    MachinePace pace_;
    TimerCheck timers_;
};

/// Host memory of that budget. What it does not keep comes from the disk: nothing is left to the system's
/// page cache.
[[nodiscard]] std::shared_ptr<const HostVolumeCache> hostMemory(const BenchDatasets& datasets,
                                                                std::uint64_t budgetBytes);

} // namespace voxsheet::bench
