#include "volume/texture_encoding.h"

#include "base/errors.h"
#include "volume/parallel_for.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include <glm/gtc/packing.hpp>

namespace voxsheet {

namespace {

/// Samples per piece of work: about a millisecond of one core.
constexpr long kGrain = 1L << 20;

template <typename T>
T loadSample(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

template <typename T>
void storeTexel(std::byte* to, T value) {
    std::memcpy(to, &value, sizeof(T));
}

/// Stored integer as an unsigned one of the same order: signed types move up by half their range.
template <typename T>
std::make_unsigned_t<T> shifted(T value) {
    using U = std::make_unsigned_t<T>;
    if constexpr (std::is_signed_v<T>) {
        return static_cast<U>(static_cast<int>(value) - std::numeric_limits<T>::min());
    } else {
        return value;
    }
}

template <typename T>
void encodeNormalised(TexelFormat format, const std::byte* stored, std::byte* texels, long n) {
    for (long i = 0; i < n; ++i) {
        const auto bits = shifted(loadSample<T>(stored + static_cast<std::size_t>(i) * sizeof(T)));
        if (format == TexelFormat::R8) {
            storeTexel(texels + i, static_cast<std::uint8_t>(bits));
        } else {
            // 257 * 255 = 65535: an 8-bit fraction of one is the same 16-bit fraction of one.
            const unsigned factor = sizeof(T) == 1 ? 257U : 1U;
            storeTexel(texels + 2 * i, static_cast<std::uint16_t>(bits * factor));
        }
    }
}

template <typename T>
void encodeFloat(const TextureEncoding& encoding, const std::byte* stored, std::byte* texels, long n) {
    const double factor = 1.0 / encoding.storedScale;
    for (long i = 0; i < n; ++i) {
        const T sample = loadSample<T>(stored + static_cast<std::size_t>(i) * sizeof(T));
        double offset = 0.0;
        if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
            // 64-bit integers lose their low bits in a double: subtract the offset first.
            offset = static_cast<double>(static_cast<long double>(sample) -
                                         static_cast<long double>(encoding.storedOffset));
        } else {
            offset = static_cast<double>(sample) - encoding.storedOffset;
        }
        const auto texel = static_cast<float>(offset * factor);
        if (encoding.format == TexelFormat::R16F)
            storeTexel(texels + 2 * i, glm::packHalf1x16(texel));
        else
            storeTexel(texels + 4 * i, texel);
    }
}

struct EncodeRange {
    const TextureEncoding& encoding;
    const std::byte* stored;
    std::byte* texels;
    long n;

    template <typename T>
    void operator()() const {
        if constexpr (std::is_integral_v<T> && sizeof(T) <= 2) {
            if (encoding.format == TexelFormat::R8 || encoding.format == TexelFormat::R16) {
                encodeNormalised<T>(encoding.format, stored, texels, n);
                return;
            }
        }
        encodeFloat<T>(encoding, stored, texels, n);
    }
};

} // namespace

std::size_t texelFormatBytes(TexelFormat format) noexcept {
    switch (format) {
    case TexelFormat::R8:
        return 1;
    case TexelFormat::R16:
    case TexelFormat::R16F:
        return 2;
    case TexelFormat::R32F:
        break;
    }
    return 4;
}

TextureEncoding chooseTextureEncoding(ScalarType type, double storedMin, double storedMax,
                                      bool exactR8Filtering, FloatTexels floatTexels) {
    const TexelFormat narrow = exactR8Filtering ? TexelFormat::R8 : TexelFormat::R16;
    switch (type) {
    case ScalarType::U8:
        return {narrow, 255.0, 0.0};
    case ScalarType::I8:
        return {narrow, 255.0, -128.0};
    case ScalarType::U16:
        return {TexelFormat::R16, 65535.0, 0.0};
    case ScalarType::I16:
        return {TexelFormat::R16, 65535.0, -32768.0};
    case ScalarType::F32:
        if (floatTexels == FloatTexels::Full) return {TexelFormat::R32F, 1.0, 0.0};
        break;
    default:
        break;
    }
    const double extent = storedMax - storedMin;
    const bool usable = extent > 0.0 && extent <= std::numeric_limits<double>::max();
    if (floatTexels == FloatTexels::Half)
        return {TexelFormat::R16F, usable ? 0.5 * extent : 1.0,
                usable || extent == 0.0 ? storedMin + 0.5 * extent : 0.0};
    return {TexelFormat::R32F, usable ? extent : 1.0, usable || extent == 0.0 ? storedMin : 0.0};
}

bool isVerbatim(ScalarType type, const TextureEncoding& encoding) noexcept {
    switch (type) {
    case ScalarType::U8:
        return encoding.format == TexelFormat::R8;
    case ScalarType::U16:
        return encoding.format == TexelFormat::R16;
    case ScalarType::F32:
        return encoding.format == TexelFormat::R32F && encoding.storedScale == 1.0 &&
               encoding.storedOffset == 0.0;
    default:
        return false;
    }
}

void encodeTexels(ScalarType type, const TextureEncoding& encoding, std::span<const std::byte> stored,
                  std::span<std::byte> texels) {
    const std::size_t sampleBytes = scalarBytes(type);
    const std::size_t texelBytes = texelFormatBytes(encoding.format);
    const std::size_t count = stored.size() / sampleBytes;
    if (stored.size() != count * sampleBytes || texels.size() != count * texelBytes) {
        throw InternalError("texel conversion", "the sizes of samples and texels do not match");
    }
    parallelFor(static_cast<long>(count), kGrain, [&](long begin, long end) {
        const auto first = static_cast<std::size_t>(begin);
        visitScalar(type, EncodeRange{encoding, stored.data() + first * sampleBytes,
                                      texels.data() + first * texelBytes, end - begin});
    });
}

} // namespace voxsheet
