// Figures of the time-N bench.
#pragma once

#include "bench/time_n/time_n_result.h"

#include <span>
#include <string>

namespace voxsheet::bench {

/// One run: T_N with its confidence intervals, coloured by level, the fitted lines, the bends; below it R,
/// raw and fitted.
[[nodiscard]] std::string timeNFigure(const TimeNResult& result);

/// Several techniques in one plot, as in the paper. `title` names the paper's figure.
[[nodiscard]] std::string techniquesFigure(std::span<const TimeNResult> results, const std::string& title);

} // namespace voxsheet::bench
