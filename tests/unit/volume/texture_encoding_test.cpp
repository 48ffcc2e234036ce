#include "volume/texture_encoding.h"

#include "base/errors.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace voxsheet {
namespace {

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

/// What a shader sees: the texel as a number, mapped back to a stored value.
template <typename T>
std::vector<double> roundTrip(ScalarType type, const TextureEncoding& encoding,
                              const std::vector<T>& stored) {
    std::vector<std::byte> texels(stored.size() * texelFormatBytes(encoding.format));
    encodeTexels(type, encoding, bytesOf(stored), texels);
    std::vector<double> values;
    for (std::size_t i = 0; i < stored.size(); ++i) {
        double texel = 0.0;
        if (encoding.format == TexelFormat::R8) {
            texel = static_cast<double>(std::to_integer<unsigned>(texels[i])) / 255.0;
        } else if (encoding.format == TexelFormat::R16) {
            std::uint16_t bits = 0;
            std::memcpy(&bits, &texels[2 * i], 2);
            texel = static_cast<double>(bits) / 65535.0;
        } else {
            float number = 0.0F;
            std::memcpy(&number, &texels[4 * i], 4);
            texel = static_cast<double>(number);
        }
        values.push_back(encoding.storedScale * texel + encoding.storedOffset);
    }
    return values;
}

template <typename T>
std::vector<T> everyValue() {
    std::vector<T> values;
    for (int v = std::numeric_limits<T>::min(); v <= std::numeric_limits<T>::max(); ++v) {
        values.push_back(static_cast<T>(v));
    }
    return values;
}

template <typename T>
void expectExact(ScalarType type, bool exactR8, TexelFormat format) {
    const auto stored = everyValue<T>();
    const auto encoding = chooseTextureEncoding(type, 3.0, 4.0, exactR8); // the range must not matter
    EXPECT_EQ(encoding.format, format);
    const auto values = roundTrip(type, encoding, stored);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        ASSERT_NEAR(values[i], static_cast<double>(stored[i]), 1e-9) << scalarName(type);
    }
}

TEST(TextureEncoding, NarrowIntegersAreExact) {
    expectExact<std::uint8_t>(ScalarType::U8, false, TexelFormat::R16);
    expectExact<std::int8_t>(ScalarType::I8, false, TexelFormat::R16);
    expectExact<std::uint8_t>(ScalarType::U8, true, TexelFormat::R8);
    expectExact<std::int8_t>(ScalarType::I8, true, TexelFormat::R8);
    expectExact<std::uint16_t>(ScalarType::U16, false, TexelFormat::R16);
    expectExact<std::int16_t>(ScalarType::I16, false, TexelFormat::R16);
}

TEST(TextureEncoding, FloatsPassUnchangedWithNaN) {
    const std::vector<float> stored{0.0F, -1.5e30F, std::numeric_limits<float>::quiet_NaN(), 3e-40F};
    const auto encoding = chooseTextureEncoding(ScalarType::F32, -1.5e30, 1.0, false);
    ASSERT_TRUE(isVerbatim(ScalarType::F32, encoding));
    const auto values = roundTrip(ScalarType::F32, encoding, stored);
    EXPECT_EQ(values[0], 0.0);
    EXPECT_EQ(values[1], static_cast<double>(-1.5e30F));
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_EQ(values[3], static_cast<double>(3e-40F));
}

TEST(TextureEncoding, DoublesSpendTheirBitsOnTheRange) {
    // A small structure on a large offset: as plain floats all three would be one number.
    const std::vector<double> stored{1e9, 1e9 + 0.25, 1e9 + 1.0, std::numeric_limits<double>::quiet_NaN()};
    const auto encoding = chooseTextureEncoding(ScalarType::F64, 1e9, 1e9 + 1.0, false);
    const auto values = roundTrip(ScalarType::F64, encoding, stored);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(values[i], stored[i], 1e-6);
    EXPECT_TRUE(std::isnan(values[3]));
}

TEST(TextureEncoding, WideIntegersSpendTheirBitsOnTheRange) {
    const std::vector<std::uint32_t> narrow{4'000'000'000U, 4'000'000'001U, 4'000'000'100U};
    auto encoding = chooseTextureEncoding(ScalarType::U32, 4e9, 4e9 + 100.0, false);
    auto values = roundTrip(ScalarType::U32, encoding, narrow);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(values[i], static_cast<double>(narrow[i]), 1e-5);

    const std::int64_t base = std::int64_t{1}
                              << 60; // the differences are below a double's resolution at 2^60
    const std::vector<std::int64_t> wide{base, base + 1024, base + 4096};
    encoding = chooseTextureEncoding(ScalarType::I64, static_cast<double>(base),
                                     static_cast<double>(base + 4096), false);
    values = roundTrip(ScalarType::I64, encoding, wide);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(values[i], static_cast<double>(wide[i]));
}

TEST(TextureEncoding, AConstantVolumeStaysFinite) {
    const std::vector<double> stored(10, 7.5);
    const auto encoding = chooseTextureEncoding(ScalarType::F64, 7.5, 7.5, false);
    for (const double value : roundTrip(ScalarType::F64, encoding, stored))
        EXPECT_EQ(value, 7.5);
}

TEST(TextureEncoding, LargeArraysAreConvertedWhole) {
    std::vector<std::int16_t> stored(3'000'001);
    for (std::size_t i = 0; i < stored.size(); ++i)
        stored[i] = static_cast<std::int16_t>(i * 31U);
    const auto encoding = chooseTextureEncoding(ScalarType::I16, 0.0, 1.0, false);
    const auto values = roundTrip(ScalarType::I16, encoding, stored);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        ASSERT_NEAR(values[i], static_cast<double>(stored[i]), 1e-9) << i;
    }
}

TEST(TextureEncoding, HalfFloatsSpreadOverTheRange) {
    const std::vector<float> stored{-3.0F, -1.0F, 0.25F, 4.0F, 5.0F, std::nanf("")};
    const auto encoding = chooseTextureEncoding(ScalarType::F32, -3.0, 5.0, false, FloatTexels::Half);
    EXPECT_EQ(encoding.format, TexelFormat::R16F);
    std::vector<std::byte> texels(2 * stored.size());
    encodeTexels(ScalarType::F32, encoding, bytesOf(stored), texels);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        std::uint16_t bits = 0;
        std::memcpy(&bits, texels.data() + 2 * i, 2);
        const double value = encoding.storedScale * double(glm::unpackHalf1x16(bits)) + encoding.storedOffset;
        if (std::isnan(stored[i]))
            EXPECT_TRUE(std::isnan(value));
        else
            EXPECT_NEAR(value, double(stored[i]), 4.0 / 2048) << "11 bits of half the range";
    }
    EXPECT_EQ(chooseTextureEncoding(ScalarType::U16, 0.0, 9.0, false, FloatTexels::Half).format,
              TexelFormat::R16)
        << "16-bit integers are exact as they are";
    const auto constant = chooseTextureEncoding(ScalarType::F32, 2.5, 2.5, false, FloatTexels::Half);
    EXPECT_EQ(constant.storedOffset, 2.5);
    EXPECT_GT(constant.storedScale, 0.0);
}

TEST(TextureEncoding, RefusesSizesThatDoNotMatch) {
    const std::vector<std::uint16_t> stored(4);
    std::vector<std::byte> texels(7);
    const auto encoding = chooseTextureEncoding(ScalarType::U16, 0.0, 1.0, false);
    EXPECT_THROW(encodeTexels(ScalarType::U16, encoding, bytesOf(stored), texels), InternalError);
}

} // namespace
} // namespace voxsheet
