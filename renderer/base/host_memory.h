// How much memory this machine has.
#pragma once

#include <cstdint>
#include <filesystem>

namespace voxsheet {

/// Physical memory, or the lowest limit of the control groups of this process (versions 1 and 2) if that is
/// lower; 4 GiB when neither can be told. `root` is what /proc and /sys are read below; "/" but in tests.
[[nodiscard]] std::uint64_t hostMemoryBytes(const std::filesystem::path& root = "/");

} // namespace voxsheet
