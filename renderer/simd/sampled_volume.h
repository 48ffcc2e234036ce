// What the SIMD kernels are given of one volume, table or map: plain numbers, no GL, the same for every
// instruction set.
#pragma once

#include "volume/host_texels.h"

#include <cstddef>
#include <cstdint>

namespace voxsheet::simd {

/// A volume as HostTexels holds it. Coordinates are index positions: sample centres at integers.
struct SampledVolume {
    const std::byte* first = nullptr; ///< the texel one before sample (0, 0, 0) on every axis
    TexelFormat format = TexelFormat::R8;
    std::int32_t rowTexels = 0;
    std::int32_t sliceTexels = 0;
    float samples[3] = {1.0F, 1.0F, 1.0F}; ///< per axis
    bool periodic[3] = {false, false, false};
};

/// A transfer table and the way to its entries (stages/classification.h).
struct SampledTable {
    const float* entries = nullptr;   ///< rgb and extinction per entry
    const float* integrals = nullptr; ///< stages/preintegration.h; null: not wanted
    int scale = 0;                    ///< ValueScale
    float mappedFromTexel[2] = {1.0F, 0.0F};
    float entryFromMapped[2] = {1.0F, 0.0F};
    float lastEntry = 0.0F;
    float shownBegin = 0.0F, shownEnd = 3.0e38F; ///< entries outside [shownBegin, shownEnd) show nothing
};

/// Distances to the nearest cell that shows something (stages/occupancy.h), or bounds of MIP.
struct SampledCells {
    const std::uint8_t* marks = nullptr; ///< null: nothing is skipped
    const float* largest = nullptr;      ///< of MIP
    float cellsPerTexture[3] = {1.0F, 1.0F, 1.0F};
    std::int32_t cells[3] = {1, 1, 1};
    bool periodic[3] = {false, false, false};
    float cellSamples = 4.0F; ///< stages/occupancy.h
};

} // namespace voxsheet::simd
