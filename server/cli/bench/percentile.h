// Percentiles of measured times.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxsheet::cli {

/// The smallest value that this fraction of all values does not exceed (nearest rank); 0 for none.
inline double percentile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const auto index = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size()))) - 1;
    return values[std::min(index, values.size() - 1)];
}

} // namespace voxsheet::cli
