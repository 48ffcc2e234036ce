// Figures of the time-N bench.
#pragma once

#include "bench/time_n/time_n_result.h"

#include <span>
#include <string>

namespace voxsheet::bench {

/// One run: T_N with its confidence intervals, coloured by level, the fitted lines, the bends; below it R,
/// raw and fitted, and the level; at the foot, which regimes did not appear.
[[nodiscard]] std::string timeNFigure(const TimeNResult& result);

/// One technique without dynamic resolution and with it: both curves of T_N, their fitted R, and the level.
[[nodiscard]] std::string comparisonFigure(const TimeNResult& without, const TimeNResult& with);

/// Several techniques in one plot, as in the paper. `title` names the paper's figure.
/// \param largestN  the plot ends here: the paper's insets show the low N alone
[[nodiscard]] std::string techniquesFigure(std::span<const TimeNResult> results, const std::string& title,
                                           int largestN);

} // namespace voxsheet::bench
