// Files of configs/ that the program carries inside itself.
#pragma once

#include <string_view>

namespace voxsheet::engine {

/// Throws InternalError if there is none of this name.
[[nodiscard]] std::string_view configFile(std::string_view name);

} // namespace voxsheet::engine
