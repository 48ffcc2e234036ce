// Names and colours of the values of a label map, as the key labels.names has them.
#pragma once

#include "sheet/colour.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::sheet {

struct LabelName {
    std::string name; ///< may be empty
    std::optional<Colour> colour;
    bool operator==(const LabelName&) const = default;
};

/// Labels separated by semicolons: `VALUE: NAME`, `VALUE: NAME #rrggbb` or `VALUE #rrggbb`, VALUE a whole
/// number, each once. Throws InvalidInput (field labels.names) that quotes the part at fault.
[[nodiscard]] std::map<std::int64_t, LabelName> parseLabelNames(std::string_view text);

} // namespace voxsheet::sheet
