// Units as people write them.
#pragma once

#include <string>

namespace voxsheet::engine {

/// Powers of one digit, with or without a minus sign, raised: "e/Å^3" becomes "e/Å³", "m^-1" "m⁻¹". UTF-8.
[[nodiscard]] std::string unitText(const std::string& unit);

} // namespace voxsheet::engine
