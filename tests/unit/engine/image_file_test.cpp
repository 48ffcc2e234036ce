#include "base/errors.h"
#include "engine/canvas.h"
#include "engine/image_file.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <OpenImageIO/imageio.h>

namespace voxsheet::engine {
namespace {

/// Left half opaque orange, right half `alpha` of it.
TilePixels picture(unsigned char alpha) {
    TilePixels pixels;
    pixels.size = {8, 4};
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const unsigned a = x < 4 ? 255U : alpha;
            for (const unsigned c : {200U, 120U, 40U}) {
                pixels.rgba8.push_back(static_cast<unsigned char>(c * a / 255U));
            }
            pixels.rgba8.push_back(static_cast<unsigned char>(a));
        }
    }
    return pixels;
}

struct ReadBack {
    OIIO::ImageSpec spec;
    std::vector<float> values;
};

ReadBack readBack(const std::filesystem::path& file) {
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(file.string(), &wish);
    if (!input) throw std::runtime_error(OIIO::geterror());
    ReadBack back{input->spec(), {}};
    back.values.resize(static_cast<std::size_t>(back.spec.width * back.spec.height * back.spec.nchannels));
    input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, back.values.data());
    return back;
}

TEST(ImageFile, OpaquePicturesHaveNoAlphaChannel) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.png", "a.jpg", "a.webp"}) {
        writeImageFile(picture(255), folder.path() / name);
        const ReadBack back = readBack(folder.path() / name);
        EXPECT_EQ(back.spec.nchannels, 3) << name;
        EXPECT_EQ(back.spec.width, 8);
        EXPECT_NEAR(back.values[0], 200 / 255.0, 0.03) << name;
    }
    EXPECT_EQ(readBack(folder.path() / "a.png").spec.get_string_attribute("oiio:ColorSpace"), "sRGB");
}

TEST(ImageFile, PngHoldsStraightAlpha) {
    const test::TemporaryFolder folder;
    writeImageFile(picture(128), folder.path() / "t.png");
    const ReadBack back = readBack(folder.path() / "t.png");
    ASSERT_EQ(back.spec.nchannels, 4);
    const std::size_t right = 7 * 4;
    EXPECT_NEAR(back.values[right], 200 / 255.0, 0.01) << "the colour itself, not what is left of it";
    EXPECT_NEAR(back.values[right + 3], 128 / 255.0, 0.005);
}

TEST(ImageFile, FloatFormatsKeepTheFloats) {
    const test::TemporaryFolder folder;
    TilePixels pixels;
    pixels.size = {2, 1};
    pixels.rgba32f = {0.123456F, 0.5F, 0.25F, 0.75F, 0.0F, 0.0F, 0.0F, 0.0F};
    for (const char* name : {"f.exr", "f.tif"}) {
        EXPECT_EQ(pixelFormatFor(name), PixelFormat::Rgba32F);
        writeImageFile(pixels, folder.path() / name);
        auto input = OIIO::ImageInput::open((folder.path() / name).string());
        ASSERT_TRUE(input);
        std::vector<float> values(8);
        input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data());
        EXPECT_EQ(values[0], 0.123456F) << name;
        EXPECT_EQ(values[3], 0.75F) << name;
    }
}

TEST(ImageFile, AFailedWriteLeavesTheOldFileAndNothingElse) {
    const test::TemporaryFolder folder;
    TilePixels broken = picture(255);
    broken.rgba8.pop_back();
    std::ofstream(folder.path() / "a.png") << "old";
    EXPECT_THROW(writeImageFile(broken, folder.path() / "a.png"), InvalidInput);
    EXPECT_THROW(writeImageFile(picture(255), folder.path() / "no such folder" / "a.png"), IoError);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    EXPECT_EQ(std::filesystem::file_size(folder.path() / "a.png"), 3U);
}

TEST(ImageFile, UnknownEndingsAreRefused) {
    EXPECT_THROW(static_cast<void>(pixelFormatFor("a.bmp")), InvalidInput);
    EXPECT_THROW(static_cast<void>(pixelFormatFor("noending")), InvalidInput);
    EXPECT_EQ(pixelFormatFor("A.PNG"), PixelFormat::Rgba8);
}

TEST(Canvas, ACentredParagraphIsWrappedAndStandsInTheMiddle) {
    Typesetter typesetter;
    Canvas canvas({80, 120}, PixelFormat::Rgba8, {0, 0, 0, 1}, typesetter);
    canvas.paragraph({{0, 0}, {80, 120}}, "induced by the vacancy", 12, {1, 1, 1, 1}, TextAlign::Centre);
    const TilePixels pixels = std::move(canvas).take();
    std::vector<int> rows;
    std::vector<int> columns;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 80; ++x)
            if (pixels.rgba8[4 * static_cast<std::size_t>(80 * y + x)] > 40) {
                rows.push_back(y);
                columns.push_back(x);
            }
    ASSERT_FALSE(rows.empty());
    const auto [top, bottom] = std::minmax_element(rows.begin(), rows.end());
    const auto [left, right] = std::minmax_element(columns.begin(), columns.end());
    EXPECT_GT(*bottom - *top, 24) << "more lines than one";
    EXPECT_NEAR((*top + *bottom) / 2.0, 60.0, 6.0);
    EXPECT_NEAR((*left + *right) / 2.0, 40.0, 4.0);
}

TEST(Canvas, PicturesAndBoxesStandWhereTheyArePut) {
    Typesetter typesetter;
    Canvas canvas({10, 6}, PixelFormat::Rgba8, {0, 0, 0, 1}, typesetter);
    canvas.put(picture(255), {1, 1});
    canvas.fill({{0, 0}, {1, 6}}, {1, 1, 1, 0.5F});
    EXPECT_NO_THROW(canvas.put(picture(255), {-5, 4})) << "what hangs over is cut off";
    const TilePixels pixels = std::move(canvas).take();
    const auto at = [&](int x, int y) { return pixels.rgba8[static_cast<std::size_t>(y * 10 + x) * 4]; };
    EXPECT_EQ(at(1, 1), 200);
    EXPECT_EQ(at(8, 4), 200);
    EXPECT_EQ(at(9, 4), 0);
    EXPECT_EQ(at(0, 3), 128);
    EXPECT_EQ(at(2, 5), 200) << "the right end of the picture that hangs over";
}

TEST(Canvas, PicturesAreNotTouched) {
    TilePixels floats;
    TilePixels bytes;
    floats.size = bytes.size = {256, 1};
    for (int byte = 0; byte < 256; ++byte) {
        bytes.rgba8.insert(bytes.rgba8.end(), 4, static_cast<unsigned char>(byte));
        floats.rgba32f.insert(floats.rgba32f.end(), 4, std::sqrt(static_cast<float>(byte)));
    }
    Typesetter typesetter;
    Canvas ofBytes({256, 1}, PixelFormat::Rgba8, {0, 0, 0, 1}, typesetter);
    ofBytes.put(bytes, {0, 0});
    EXPECT_EQ(std::move(ofBytes).take().rgba8, bytes.rgba8);
    Canvas ofFloats({256, 1}, PixelFormat::Rgba32F, {0, 0, 0, 1}, typesetter);
    ofFloats.put(floats, {0, 0});
    EXPECT_EQ(std::move(ofFloats).take().rgba32f, floats.rgba32f);
    Canvas other({256, 1}, PixelFormat::Rgba32F, {0, 0, 0, 1}, typesetter);
    EXPECT_THROW(other.put(bytes, {0, 0}), InternalError);
}

TEST(Canvas, WhatIsDrawnOverBytesIsTheNearestByteOfWhatIsDrawnOverFloats) {
    Typesetter typesetter;
    for (int step = 0; step <= 510; ++step) {
        const float part = static_cast<float>(step) / 510.0F; // every byte, and every tie between two
        const auto over = [&](PixelFormat format, const glm::vec4& background) {
            Canvas canvas({1, 1}, format, background, typesetter);
            canvas.fill({{0, 0}, {1, 1}}, {part, 1.0F - part, 2.0F * part, part});
            return std::move(canvas).take();
        };
        for (const glm::vec4 background :
             {glm::vec4(0, 0, 0, 1), glm::vec4(0.2F, 0.4F, 1, 1), glm::vec4(0)}) {
            const auto bytes = over(PixelFormat::Rgba8, background).rgba8;
            const auto floats = over(PixelFormat::Rgba32F, background).rgba32f;
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_EQ(bytes.at(c), std::lround(std::min(floats.at(c), 1.0F) * 255.0F)) << step;
        }
    }
}

TEST(Canvas, TextLeavesInkAndIsShortenedToItsWidth) {
    try {
        static_cast<void>(pictureFont());
    } catch (const Unsupported&) {
        GTEST_SKIP() << "no font on this machine";
    }
    Typesetter typesetter;
    Canvas canvas({200, 40}, PixelFormat::Rgba8, {0, 0, 0, 1}, typesetter);
    EXPECT_GT(canvas.textWidth("a long line of text", 14), canvas.textWidth("a long", 14));
    canvas.text({10, 20}, TextAlign::Left, "a line that is far too long for the place it has got", 14,
                {1, 1, 1, 1}, 100);
    const TilePixels pixels = std::move(canvas).take();
    int inside = 0;
    int outside = 0;
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 200; ++x) {
            const bool ink = pixels.rgba8[static_cast<std::size_t>(y * 200 + x) * 4] > 100;
            (x < 114 ? inside : outside) += ink ? 1 : 0;
        }
    }
    EXPECT_GT(inside, 100);
    EXPECT_EQ(outside, 0);
}

TEST(Typesetter, KnowsLettersBeyondAscii) {
    try {
        Typesetter setter;
        const auto angstrom = setter.set("Å", 20).coverage;
        EXPECT_NE(angstrom, setter.set("A", 20).coverage);
        EXPECT_NE(angstrom, setter.set("\xff", 20).coverage);
        EXPECT_EQ(setter.width("ÅÅ", 20), 2 * setter.width("Å", 20));
        // Letters that were kept, also over another size, are the ones that are drawn at first.
        EXPECT_NE(setter.set("Å", 12).size, setter.set("Å", 20).size);
        EXPECT_EQ(setter.set("Å", 20).coverage, angstrom);
        EXPECT_EQ(Typesetter().set("Å", 12).coverage, setter.set("Å", 12).coverage);
    } catch (const Unsupported&) {
        GTEST_SKIP() << "no font on this machine";
    }
}

} // namespace
} // namespace voxsheet::engine
