// How much memory textures may take when the user names no budget. Private to this room.
#pragma once

#include <cstdint>
#include <string>

namespace voxsheet::gpu {

struct TextureMemory {
    std::uint64_t deviceBytes = 0;   ///< what there is to share; 0 when the driver does not tell
    std::uint64_t defaultBudget = 0; ///< bytes
    std::string reason;              ///< of the default: "a quarter of this machine's memory"
};

/// Software renderers keep textures in RAM: a quarter of it, or of the control group's limit if that is
/// lower. Hardware: six tenths of the GPU's memory where the driver tells it (NVIDIA, AMD), else 1 GiB. Needs
/// a current context.
[[nodiscard]] TextureMemory textureMemory(bool software);

} // namespace voxsheet::gpu
