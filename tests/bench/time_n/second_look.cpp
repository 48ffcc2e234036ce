#include "bench/time_n/second_look.h"

#include <algorithm>
#include <cstdlib>

namespace voxsheet::bench {

namespace {

/// Noise moves the N at which a bend is seen by some steps.
bool isNear(int n, int otherN, int spacing) {
    constexpr int kLeast = 2;
    constexpr int kParts = 4; ///< or a quarter of the larger N
    return std::abs(n - otherN) <= std::max({kLeast, spacing, std::max(n, otherN) / kParts});
}

} // namespace

bool SecondLook::wantsAnother(int lastN, int spacing) {
    const bool agrees = foundAfterN_ && isNear(*foundAfterN_, lastN, spacing);
    if (agrees || passes_ >= kMostPasses) return false;
    foundAfterN_ = lastN;
    ++passes_;
    return true;
}

} // namespace voxsheet::bench
