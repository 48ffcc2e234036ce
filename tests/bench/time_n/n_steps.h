// At which N a time-N curve is measured.
#pragma once

#include <algorithm>

namespace voxsheet::bench {

/// The N after n: each one up to 4, twice as many up to `step` (with a coarse one the points at small N would
/// take most of the time), then its multiples, and `last`; beyond that n + 1.
[[nodiscard]] constexpr int nextN(int n, int step, int last) {
    if (n >= last || n < std::min(step, 4)) return n + 1;
    if (n < step) return std::min({2 * n, step, last});
    return std::min(last, (n / step + 1) * step);
}

} // namespace voxsheet::bench
