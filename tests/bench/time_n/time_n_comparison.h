// What dynamic resolution changes: the same technique without it and with it, side by side.
#pragma once

#include "bench/time_n/time_n_result.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxsheet::bench {

/// One technique with one kind of shading. Points into the results that it was made from.
struct TimeNComparison {
    std::string technique;
    bool shading = false;
    const TimeNResult* without = nullptr; ///< --dr off; null: not measured
    const TimeNResult* with = nullptr;    ///< the first of another criterion; null: not measured
};

/// In the order in which technique and shading first appear. `results` must outlive it.
[[nodiscard]] std::vector<TimeNComparison> comparisonsOf(std::span<const TimeNResult> results);

/// Whether the curve goes on more steeply: where it flattens, or times fell for a while, something else was
/// measured.
[[nodiscard]] bool goesOnSteeper(const TimeNTransition& transition);

/// "13", or "≥ 64" when nothing broke the rule up to the last N that was measured.
[[nodiscard]] std::string nMaxText(const TimeNResult& result);

/// A table in Markdown: per technique and shading the N of each transition, N max without and with dynamic
/// resolution, and how straight each level's segment is; below it which regimes did not appear.
[[nodiscard]] std::string summaryTable(std::span<const TimeNResult> results);

/// The same as a JSON list of {technique, shading, n_max_without, n_max_with, n_measured,
/// texture_swapping_from, disk_reading_from, transitions_without, level_changes}.
[[nodiscard]] std::string summaryJson(std::span<const TimeNResult> results);

} // namespace voxsheet::bench
