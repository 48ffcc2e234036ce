#include "import/tiff/packed_samples.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <tiffio.h>

namespace voxsheet::import {

namespace {

std::uint32_t bitsAt(const std::byte* row, std::size_t bit, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i, ++bit)
        value = (value << 1U) | ((std::to_integer<std::uint32_t>(row[bit / 8]) >> (7 - bit % 8)) & 1U);
    return value;
}

template <typename T>
T integerFrom(std::uint32_t value, int bits) {
    if constexpr (std::is_signed_v<T>) { // the highest bit is the sign
        const auto sign = 1U << static_cast<unsigned>(bits - 1);
        return static_cast<T>(static_cast<std::int32_t>((value ^ sign)) - static_cast<std::int32_t>(sign));
    } else {
        return static_cast<T>(value);
    }
}

} // namespace

std::optional<SampleFormat> sampleFormatOf(int bits, int tiffSampleFormat) {
    if (tiffSampleFormat == SAMPLEFORMAT_IEEEFP) {
        if (bits == 16 || bits == 32) return SampleFormat{ScalarType::F32, bits};
        if (bits == 64) return SampleFormat{ScalarType::F64, bits};
        return std::nullopt;
    }
    const bool isSigned = tiffSampleFormat == SAMPLEFORMAT_INT;
    if (!isSigned && tiffSampleFormat != SAMPLEFORMAT_UINT && tiffSampleFormat != SAMPLEFORMAT_VOID)
        return std::nullopt;
    if (bits >= 1 && bits <= 8) return SampleFormat{isSigned ? ScalarType::I8 : ScalarType::U8, bits};
    if (bits > 8 && bits <= 16) return SampleFormat{isSigned ? ScalarType::I16 : ScalarType::U16, bits};
    if (bits == 32) return SampleFormat{isSigned ? ScalarType::I32 : ScalarType::U32, bits};
    if (bits == 64) return SampleFormat{isSigned ? ScalarType::I64 : ScalarType::U64, bits};
    return std::nullopt;
}

std::size_t rowBytes(const SampleFormat& format, std::size_t samples) {
    return (samples * static_cast<std::size_t>(format.bits) + 7) / 8;
}

void unpackRow(const SampleFormat& format, const std::byte* row, std::size_t first, std::size_t stride,
               std::span<std::byte> out) {
    visitScalar(format.type, [&]<typename T>() {
        const auto count = out.size() / sizeof(T);
        for (std::size_t i = 0; i < count; ++i) {
            const auto sample = first + i * stride;
            T value{};
            if constexpr (std::is_floating_point_v<T>) {
                unsigned short half = 0;
                std::memcpy(&half, row + 2 * sample, sizeof(half));
                value = static_cast<T>(floatFromHalf(half));
            } else {
                const auto bits = static_cast<std::size_t>(format.bits);
                value = integerFrom<T>(bitsAt(row, sample * bits, format.bits), format.bits);
            }
            std::memcpy(out.data() + i * sizeof(T), &value, sizeof(T));
        }
    });
}

float floatFromHalf(unsigned short half) {
    const unsigned exponent = (half >> 10U) & 31U;
    const unsigned fraction = half & 1023U;
    float value = 0.0F;
    if (exponent == 31U)
        value =
            fraction == 0 ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
    else if (exponent == 0U)
        value = std::ldexp(static_cast<float>(fraction), -24);
    else
        value = std::ldexp(static_cast<float>(fraction + 1024U), static_cast<int>(exponent) - 25);
    return (half & 0x8000U) != 0 ? -value : value;
}

} // namespace voxsheet::import
