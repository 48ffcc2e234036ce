// How stored samples become texels: the texture format, and the affine map between the two. No GL.
#pragma once

#include "volume/scalar_type.h"

#include <cstddef>
#include <span>

namespace voxsheet {

/// Unsigned normalised 8 and 16 bit, 16-bit and 32-bit float; one channel.
enum class TexelFormat { R8, R16, R16F, R32F };

/// Texels of volumes that would be 32-bit floats.
enum class FloatTexels {
    Full, ///< 32-bit floats
    Half  ///< 16-bit floats over [-1, 1], the ends of the values that occur: half the memory, 11 significant
          ///< bits
};

[[nodiscard]] std::size_t texelFormatBytes(TexelFormat format) noexcept;

struct TextureEncoding {
    TexelFormat format = TexelFormat::R32F;
    double storedScale =
        1.0; ///< stored = storedScale * texel + storedOffset, as the shader samples the texel
    double storedOffset = 0.0;

    bool operator==(const TextureEncoding&) const = default;
};

/// \param type                  of the stored array
/// \param storedMin,storedMax   over its finite samples; used for types wider than a float's mantissa only
/// \param exactR8Filtering      the device filters R8 textures with more than 8 bits (llvmpipe does not)
/// U8, I8: R8 when exactR8Filtering, else R16 with texel bits 257 * stored; U16, I16: R16; signed types are
/// shifted by half their range; all four exact. F32: R32F as it is. Others: R32F of (stored - storedMin) /
/// (storedMax - storedMin), so that the 24 bits of a float are spent on the range that occurs. With
/// FloatTexels::Half, F32 and the others: R16F of the stored value's place between the middle of the range
/// (0) and its ends
/// (-1 and 1).
[[nodiscard]] TextureEncoding chooseTextureEncoding(ScalarType type, double storedMin, double storedMax,
                                                    bool exactR8Filtering,
                                                    FloatTexels floatTexels = FloatTexels::Full);

/// True when texels are the stored bytes unchanged, so that no conversion pass is needed.
[[nodiscard]] bool isVerbatim(ScalarType type, const TextureEncoding& encoding) noexcept;

/// Converts samples to texels; NaN stays NaN. Large arrays are split over the machine's cores.
/// stored.size() = n * scalarBytes(type), texels.size() = n * texelFormatBytes(encoding.format); throws
/// InternalError otherwise.
void encodeTexels(ScalarType type, const TextureEncoding& encoding, std::span<const std::byte> stored,
                  std::span<std::byte> texels);

} // namespace voxsheet
