// The time-N bench: N datasets on disk, equal tiles, all N drawn for each N from 1 on; with dynamic
// resolution or without (Khanduja & Karki 2007, figures 6, 7, 8a and 8b).
#pragma once

#include "bench/time_n/time_n_result.h"

#include <functional>

namespace voxsheet::bench {

class BenchDatasets;

/// Of `datasets` the first options.maxN, which must be of options.dim.
///
/// Every N is visited options.visits times, the whole curve there and back, for a virtual machine is slower
/// at times: a frame that is not counted (it brings in what is new), and rounds of options.frames frames with
/// a turning camera (1 to 32 of them, until all visits have taken 4 s: the quicker, the noisier). The first
/// visit also draws one with FrameSpec::checkTimers for up to four tiles, and dynamic resolution decides by
/// first visits, as it would while N grows; bends that it does not answer to (off) are judged by all. When
/// dynamic resolution goes to a coarser level because of a bend after N = b, the sheets of b + 1 to N
/// datasets are measured again at that level; what was measured before is kept in `trials`. `progress` is
/// told a line for each N. Throws InvalidInput for options out of range, what a tile is at fault for (a
/// budget too small for one volume, say), Cancelled after SIGINT or SIGTERM, GpuError, IoError.
[[nodiscard]] TimeNResult timeNBench(const TimeNOptions& options, const BenchDatasets& datasets,
                                     const std::function<void(const std::string&)>& progress);

/// Throws InvalidInput for options out of range: what timeNBench asks before it begins.
void validateOptions(const TimeNOptions& options);

/// Draws the first dataset once, at full resolution, so that what cannot be measured is said before minutes
/// go into writing all of them. Throws InvalidInput (field --texture-budget) for a budget above the device's
/// memory, or one that does not hold what the picture of a single dataset needs; and as timeNBench.
void rehearse(const TimeNOptions& options, const BenchDatasets& datasets);

} // namespace voxsheet::bench
