// How much memory textures may take when the user names no budget. Private to this room.
#pragma once

#include <cstdint>

namespace voxsheet::gpu {

/// Software renderers keep textures in RAM: a quarter of it, or of the control group's limit if that is
/// lower. Hardware: six tenths of the GPU's memory where the driver tells it (NVIDIA, AMD), else 1 GiB. Needs
/// a current context.
[[nodiscard]] std::uint64_t defaultTextureBudget(bool software);

} // namespace voxsheet::gpu
