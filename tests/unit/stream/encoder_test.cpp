#include "base/errors.h"
#include "stream/encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>

namespace voxsheet::stream {
namespace {

/// A smooth picture with premultiplied alpha (or opaque).
TilePixels picture(int width, int height, bool opaque) {
    TilePixels pixels;
    pixels.size = {width, height};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int alpha = opaque ? 255 : (x * 255) / width;
            const auto channel = [&](int value) { return static_cast<unsigned char>(value * alpha / 255); };
            pixels.rgba8.insert(pixels.rgba8.end(), {channel((x * 200) / width), channel((y * 200) / height),
                                                     channel(90), static_cast<unsigned char>(alpha)});
        }
    return pixels;
}

std::vector<unsigned char> decodePng(const std::string& bytes, glm::ivec2& size) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
    image.format = PNG_FORMAT_RGBA;
    size = {static_cast<int>(image.width), static_cast<int>(image.height)};
    std::vector<unsigned char> rgba(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr), 0);
    return rgba;
}

TEST(Encoder, OpaquePngIsExact) {
    for (const bool fast : {false, true}) {
        const auto pixels = picture(67, 31, true);
        glm::ivec2 size{0};
        const auto back = decodePng(encodeImage(pixels, {.format = ImageFormat::Png, .fast = fast}), size);
        EXPECT_EQ(size, pixels.size);
        EXPECT_EQ(back, pixels.rgba8);
    }
}

TEST(Encoder, TransparentPngHasStraightAlpha) {
    const auto pixels = picture(64, 8, false);
    glm::ivec2 size{0};
    const auto back = decodePng(encodeImage(pixels, {.format = ImageFormat::Png}), size);
    for (std::size_t i = 0; i < back.size(); i += 4) {
        ASSERT_EQ(back[i + 3], pixels.rgba8[i + 3]);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(back[i + c] * back[i + 3] / 255.0, pixels.rgba8[i + c], 1.0);
    }
}

TEST(Encoder, LosslessWebpIsExact) {
    const auto pixels = picture(50, 40, true);
    const auto bytes = encodeImage(pixels, {.format = ImageFormat::Webp, .lossless = true});
    int width = 0;
    int height = 0;
    auto* data =
        WebPDecodeRGBA(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &width, &height);
    ASSERT_NE(data, nullptr);
    EXPECT_EQ(std::vector<unsigned char>(data, data + pixels.rgba8.size()), pixels.rgba8);
    WebPFree(data);
}

TEST(Encoder, JpegIsCloseAndSmaller) {
    const auto pixels = picture(128, 96, true);
    const auto bytes = encodeImage(pixels, {.format = ImageFormat::Jpeg, .quality = 90});
    EXPECT_LT(bytes.size(), pixels.rgba8.size() / 8);
    auto* decoder = tjInitDecompress();
    std::vector<unsigned char> back(pixels.rgba8.size());
    ASSERT_EQ(tjDecompress2(decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                            back.data(), 128, 0, 96, TJPF_RGBA, 0),
              0);
    tjDestroy(decoder);
    double squares = 0.0;
    for (std::size_t i = 0; i < back.size(); ++i)
        squares += std::pow(double(back[i]) - pixels.rgba8[i], 2);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(back.size())), 3.0);
}

TEST(Encoder, BufferThatDoesNotFitIsRefused) {
    auto pixels = picture(8, 8, true);
    pixels.rgba8.pop_back();
    EXPECT_THROW(static_cast<void>(encodeImage(pixels, {})), InvalidInput);
}

TEST(Encoder, ExtensionsAreKnown) {
    EXPECT_EQ(formatFromExtension("jpg"), ImageFormat::Jpeg);
    EXPECT_EQ(formatFromExtension("webp"), ImageFormat::Webp);
    EXPECT_FALSE(formatFromExtension("gif").has_value());
}

} // namespace
} // namespace voxsheet::stream
