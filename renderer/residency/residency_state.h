// Counters of what is resident on the GPU.
#pragma once

#include <cstdint>

namespace voxsheet {

/// Bytes are those of the textures' texels. "Resident" counts textures that are still being filled, too.
struct ResidencyState {
    std::uint64_t residentBytes =
        0; ///< = sampleBytes + gradientBytes + clipObjectBytes; never above the budget
    std::uint64_t budgetBytes = 0;
    std::uint64_t sampleBytes = 0;
    std::uint64_t gradientBytes = 0;
    std::uint64_t clipObjectBytes = 0;
    std::uint64_t pinnedBytes = 0;  ///< held by tiles that are being drawn
    std::uint64_t visibleBytes = 0; ///< of volumes that a page shows (WantedPriority::Visible)
    int textures = 0;               ///< whole ones
    int queuedUploads = 0;          ///< waiting or partly done
    std::uint64_t queuedBytes = 0;  ///< of them, still to be filled
    // Since the start:
    std::uint64_t uploads = 0;       ///< textures of samples that were filled
    std::uint64_t uploadedBytes = 0; ///< of them
    std::uint64_t evictions = 0;
    double uploadMs = 0.0; ///< host time of conversion and upload, and of building gradients
    double readMs = 0.0;   ///< that the render thread waited for samples to be read
};

} // namespace voxsheet
