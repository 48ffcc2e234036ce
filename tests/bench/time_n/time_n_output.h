// Runs the time-N bench and writes its files.
#pragma once

#include "bench/time_n/time_n_result.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace voxsheet::bench {

struct TimeNFiles {
    std::filesystem::path csv; ///< empty: not written
    std::filesystem::path svg; ///< empty: not written
};

using Progress = std::function<void(const std::string&)>;

/// A run for each of `runs`, over the same datasets: writes the datasets, measures, writes the files, removes
/// the datasets. The figure compares a run without dynamic resolution with one that has it when there are
/// both. `progress` is also told which regimes did not appear. Throws as timeNBench, and IoError when a file
/// cannot be written (before anything is measured).
/// \param runs  at least one; they may differ in their rule only
[[nodiscard]] std::vector<TimeNResult> runTimeN(const std::vector<TimeNOptions>& runs,
                                                const TimeNFiles& files, const Progress& progress);

/// Figures 6, 7, 8a and 8b of the paper: every technique without dynamic resolution (6: without shading, 7:
/// with) and with the slope rule (8a, 8b). Writes into `folder`: figure-6.svg, … and, as the paper's insets,
/// figure-6-low-n.svg, …; a CSV, SVG and JSON file per run; vr.svg, vr-shading.svg, … with both runs of a
/// technique; times.csv with all points; summary.md. Of `options`, technique, shading and criterion are
/// replaced. Returns the results in that order. Throws InvalidInput when one of `criteria` is neither Off nor
/// Slope. \param criteria  which of them: Off draws 6 and 7, Slope 8a and 8b; none: all
[[nodiscard]] std::vector<TimeNResult> runPaperFigures(const TimeNOptions& options,
                                                       std::span<const ResolutionCriterion> criteria,
                                                       const std::filesystem::path& folder,
                                                       const Progress& progress);

/// One result: as jsonOf(TimeNResult). Several: {"runs": [one such object each], "summary": as summaryJson}.
[[nodiscard]] std::string jsonOf(const std::vector<TimeNResult>& results);

/// What is wrong with a result's timers, for people; empty when they agree.
[[nodiscard]] std::string timerComplaint(const TimeNResult& result);

} // namespace voxsheet::bench
