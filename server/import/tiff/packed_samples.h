// Samples of TIFF files that are no whole bytes, or are floats of 16 bits, as numbers of a type that the
// store has.
#pragma once

#include "volume/scalar_type.h"

#include <cstddef>
#include <optional>
#include <span>

namespace voxsheet::import {

/// How a sample is stored; `type` is what it becomes.
struct SampleFormat {
    ScalarType type = ScalarType::U8;
    int bits = 8; ///< as stored

    bool operator==(const SampleFormat&) const = default;
    /// Neither as it is in memory, nor of whole bytes.
    [[nodiscard]] bool isPacked() const { return bits != 8 * static_cast<int>(scalarBytes(type)); }
};

/// Integers of 1 to 16, 32 and 64 bits, floats of 16 (as F32), 32 and 64; nullopt: no such numbers here.
/// \param tiffSampleFormat  TIFFTAG_SAMPLEFORMAT
[[nodiscard]] std::optional<SampleFormat> sampleFormatOf(int bits, int tiffSampleFormat);

/// Bytes of a row of `samples` samples: rows begin on whole bytes.
[[nodiscard]] std::size_t rowBytes(const SampleFormat& format, std::size_t samples);

/// Every `stride`-th sample of a packed row, from sample `first` on, into `out` (native values). Bits come
/// highest first, as libtiff hands them out; floats in native byte order.
void unpackRow(const SampleFormat& format, const std::byte* row, std::size_t first, std::size_t stride,
               std::span<std::byte> out);

/// IEEE 754 binary16.
[[nodiscard]] float floatFromHalf(unsigned short half);

} // namespace voxsheet::import
