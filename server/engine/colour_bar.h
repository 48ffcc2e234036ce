// A cell's transfer function for the page: colours as drawn, range, unit, ticks.
#pragma once

#include "engine/tile_maker.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace voxsheet::engine {

/// Where a value stands along the bar, [0, 1]; empty outside it.
[[nodiscard]] std::optional<double> barPosition(const TransferFunction& function, double value);

/// "linear", "log" or "symlog".
[[nodiscard]] const char* scaleName(ValueScale scale);

/// Some sample has no value.
[[nodiscard]] bool hasGaps(const FieldMeta& field);

inline constexpr int kColourBarStops = 64;

/// {stops: [[position, r, g, b, a]...], low, high, scale, unit, quantity, field, map, nan, below, above,
/// diverging, shared, opacity: [[position, opacity]...], ticks: [{pos, value, label}], isovalues: [{value,
/// position, colour: [r, g, b], opacity}...], colouredBy, layers}: opacity is what transfer.opacity auto came
/// to, to be edited further; isovalues are those of the surfaces shown, position null outside the bar; nan,
/// below and above are colours [r, g, b, a] of samples without a value (null: there are none) and of values
/// outside the range (null: as at its ends); colouredBy is null, or of the volume that colours the surfaces
/// the bar that explains them, with stops, low, high, scale, unit, quantity, field, map, ticks; layers are
/// such bars of the volumes blended into the picture or painted over it, each with name, weight and labels;
/// labels are null, or of a label map the legend [{value, name, colour: [r, g, b], hidden}...].
[[nodiscard]] nlohmann::json describeColourBar(const CellLook& look);

} // namespace voxsheet::engine
