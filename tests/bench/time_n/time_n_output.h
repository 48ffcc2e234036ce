// Runs the time-N bench and writes its files.
#pragma once

#include "bench/time_n/time_n_result.h"

#include <filesystem>
#include <functional>
#include <string>

namespace voxsheet::bench {

struct TimeNFiles {
    std::filesystem::path csv; ///< empty: not written
    std::filesystem::path svg; ///< empty: not written
};

using Progress = std::function<void(const std::string&)>;

/// One run: writes the datasets, measures, writes the files, removes the datasets. `progress` is also told
/// which regimes did not appear. Throws as timeNBench, and IoError when a file cannot be written (before
/// anything is measured).
[[nodiscard]] TimeNResult runTimeN(const TimeNOptions& options, const TimeNFiles& files,
                                   const Progress& progress);

/// Figures 6, 7, 8a and 8b of the paper: every technique without dynamic resolution (6: without shading, 7:
/// with) and with the slope rule (8a, 8b). Writes figure-6.svg, … and a CSV, SVG and JSON file per run into
/// `folder`. Of `options`, technique, shading and criterion are replaced. Returns the results in that order.
[[nodiscard]] std::vector<TimeNResult>
runPaperFigures(TimeNOptions options, const std::filesystem::path& folder, const Progress& progress);

/// {"runs": [one object of jsonOf(TimeNResult) each]}
[[nodiscard]] std::string jsonOf(const std::vector<TimeNResult>& results);

/// What is wrong with a result's timers, for people; empty when they agree.
[[nodiscard]] std::string timerComplaint(const TimeNResult& result);

} // namespace voxsheet::bench
