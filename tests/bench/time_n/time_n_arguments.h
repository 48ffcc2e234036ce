// The options of the time-N bench as text, for both of its programs.
#pragma once

#include "bench/time_n/time_n_result.h"

#include <optional>
#include <string>
#include <vector>

namespace voxsheet::bench {

/// What is not in TimeNOptions as it is typed.
struct TimeNTexts {
    std::string tile = "256x256";
    std::string textureBudget = "256M";
    std::string memoryBudget = "512M";
    std::optional<std::string> dr; ///< a criterion, or several with commas: a run each; not given: off
    std::optional<double> drLimit; ///< of --dr time, rate, count or bytes
};

/// "256x256", "320x200"; a single number is both. Throws InvalidInput.
[[nodiscard]] glm::ivec2 parseTileSize(const std::string& text);

/// Options with the texts put in, one for each criterion of texts.dr. Throws InvalidInput, with field, for
/// what cannot be.
[[nodiscard]] std::vector<TimeNOptions> withTexts(const TimeNOptions& options, const TimeNTexts& texts);

/// The criteria of texts.dr; none when it is not given. Throws InvalidInput, with field, for what is none.
[[nodiscard]] std::vector<ResolutionCriterion> criteriaOf(const TimeNTexts& texts);

} // namespace voxsheet::bench
