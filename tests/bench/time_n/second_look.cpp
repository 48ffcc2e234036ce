#include "bench/time_n/second_look.h"

#include <algorithm>
#include <cstdlib>

namespace voxsheet::bench {

namespace {

/// Noise moves the N at which a bend is seen by some steps.
bool isNear(int n, int otherN) {
    constexpr int kSteps = 2;
    constexpr int kParts = 4; ///< or a quarter of the larger N
    return std::abs(n - otherN) <= std::max(kSteps, std::max(n, otherN) / kParts);
}

} // namespace

bool SecondLook::wantsAnother(int lastN) {
    const bool agrees = foundAfterN_ && isNear(*foundAfterN_, lastN);
    if (agrees || passes_ >= kMostPasses) return false;
    foundAfterN_ = lastN;
    ++passes_;
    return true;
}

} // namespace voxsheet::bench
