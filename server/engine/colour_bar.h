// A cell's transfer function for the page: colours as drawn, range, unit, ticks.
#pragma once

#include "engine/tile_maker.h"

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::engine {

inline constexpr int kColourBarStops = 64;

/// {stops: [[position, r, g, b, a]...], low, high, scale, unit, quantity, field, map, diverging, shared,
/// opacity: [[position, opacity]...], ticks: [{pos, value, label}]}: opacity is what transfer.opacity auto
/// came to, to be edited further.
[[nodiscard]] nlohmann::json describeColourBar(const CellLook& look);

} // namespace voxsheet::engine
