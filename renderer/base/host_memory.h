// How much memory this machine has.
#pragma once

#include <cstdint>

namespace voxsheet {

/// Physical memory, or the control group's limit (version 2) if that is lower; 4 GiB when neither can be
/// told.
[[nodiscard]] std::uint64_t hostMemoryBytes();

} // namespace voxsheet
