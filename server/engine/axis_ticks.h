// Round numbers along a colour bar.
#pragma once

#include "volume/transfer_function.h"

#include <string>
#include <vector>

namespace voxsheet::engine {

struct Tick {
    double position; ///< in [0, 1] along the bar
    double value;
    std::string label;
};

/// About `wanted` (>= 2) ticks at 1, 2 or 5 times a power of ten (Linear), or at powers of ten (Log; SymLog
/// with both signs and zero) within the function's low..high. Never more than twice `wanted`, and at least
/// two.
[[nodiscard]] std::vector<Tick> axisTicks(const TransferFunction& function, int wanted);

/// The shortest text that tells the value from others at the given resolution: "0.25", "-1.2e-05", "1500".
[[nodiscard]] std::string numberLabel(double value, double resolution);

} // namespace voxsheet::engine
