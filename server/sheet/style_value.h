// One value of a style key, typed.
#pragma once

#include "sheet/colour.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

/// The value "none": switched off, as opposed to "not set here" (which is the key's absence).
struct None {
    bool operator==(const None&) const = default;
};

/// The value "auto": chosen from the data, by the rule in the key's documentation.
struct Automatic {
    bool operator==(const Automatic&) const = default;
};

struct OpacityStop {
    double position = 0.0; ///< in [0, 1] over the range
    double opacity = 0.0;  ///< in [0, 1], per transfer.unitLength
    bool operator==(const OpacityStop&) const = default;
};

struct ColourStop {
    double position = 0.0; ///< in [0, 1] over the range
    Colour colour;         ///< opaque
    bool operator==(const ColourStop&) const = default;
};

/// A table of finite numbers, all rows of one length.
struct NumberTable {
    std::vector<std::vector<double>> rows;
    bool operator==(const NumberTable&) const = default;
};

using ColourList = std::vector<Colour>;
using OpacityStops = std::vector<OpacityStop>;
using ColourStops = std::vector<ColourStop>;

/// Which alternatives a key takes is in its KeySpec. Choices and names are strings.
using StyleValue = std::variant<None, Automatic, double, std::int64_t, std::string, Colour, glm::dvec3,
                                OpacityStops, ColourStops, NumberTable, ColourList>;

/// The values that one layer sets; keys that are absent are inherited.
using StyleMap = std::map<std::string, StyleValue>;

/// An edit of one layer: a value sets, nullopt resets to inherited.
using StylePatch = std::map<std::string, std::optional<StyleValue>>;

/// The form that parseStyleValue reads back to an equal value.
[[nodiscard]] nlohmann::json styleValueToJson(const StyleValue& value);
/// A flat object of dotted keys.
[[nodiscard]] nlohmann::json styleMapToJson(const StyleMap& style);
/// The form that parseStyleText reads back to an equal value; for messages, links and `--set`.
[[nodiscard]] std::string styleValueText(const StyleValue& value);

} // namespace voxsheet::sheet
