// Damaged and hostile TIFF files: the right voxels or an Error with one sentence, never anything else.
#include "tiff_bytes.h"
#include "vtk_fixture.h"

#include <random>

namespace voxsheet::import::testing {
namespace {

/// A little-endian TIFF of one page of 4 x 4 bytes, put together by hand. The strip begins at 8.
class TiffByHand {
public:
    static constexpr std::uint32_t firstPage = 8 + 16;

    void set(std::uint16_t tag, std::uint32_t value) { tags_[tag] = value; }
    std::uint32_t next = 0; ///< offset of the next page

    [[nodiscard]] std::string bytes() const {
        std::string text("II*\0", 4);
        append(text, firstPage);
        for (int i = 0; i < 16; ++i)
            text += static_cast<char>(i);
        append(text, static_cast<std::uint16_t>(tags_.size()));
        for (const auto& [tag, value] : tags_) {
            append(text, tag);
            append(text, std::uint16_t{4}); // LONG
            append(text, std::uint32_t{1});
            append(text, value);
        }
        append(text, next);
        return text;
    }

private:
    template <typename T>
    static void append(std::string& text, T value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }

    std::map<std::uint16_t, std::uint32_t> tags_{
        {TIFFTAG_IMAGEWIDTH, 4},      {TIFFTAG_IMAGELENGTH, 4},  {TIFFTAG_BITSPERSAMPLE, 8},
        {TIFFTAG_COMPRESSION, 1},     {TIFFTAG_PHOTOMETRIC, 1},  {TIFFTAG_STRIPOFFSETS, 8},
        {TIFFTAG_SAMPLESPERPIXEL, 1}, {TIFFTAG_ROWSPERSTRIP, 4}, {TIFFTAG_STRIPBYTECOUNTS, 16}};
};

using TiffHostile = FormatsTest;

TEST_F(TiffHostile, AFileByHandIsRead) {
    const auto loaded = loadAny(write("a.tif", TiffByHand().bytes()));
    std::vector<std::uint8_t> expected(16);
    for (std::size_t i = 0; i < 16; ++i)
        expected[i] = static_cast<std::uint8_t>(i);
    EXPECT_EQ(loaded.values<std::uint8_t>(), expected);
}

TEST_F(TiffHostile, RefusesWhatCannotBe) {
    const auto with = [&](std::uint16_t tag, std::uint32_t value) {
        TiffByHand tiff;
        tiff.set(tag, value);
        return sentenceOf(write("a.tif", tiff.bytes()));
    };
    expectMentions(with(TIFFTAG_IMAGEWIDTH, 2'000'000'000), "cannot come from a file of");
    expectMentions(with(TIFFTAG_IMAGELENGTH, 4'000'000'000), "dimension of 4000000000");
    expectMentions(with(TIFFTAG_IMAGELENGTH, 5000), "cannot come from a file of");
    EXPECT_FALSE(with(TIFFTAG_IMAGEWIDTH, 0).empty());
    EXPECT_FALSE(with(TIFFTAG_IMAGELENGTH, 0).empty());
    expectMentions(with(TIFFTAG_BITSPERSAMPLE, 24), "24 bits");
    expectMentions(with(TIFFTAG_BITSPERSAMPLE, 17), "17 bits");
    expectMentions(with(TIFFTAG_COMPRESSION, 777), "(number 777); save it without compression");
    expectMentions(with(TIFFTAG_PHOTOMETRIC, 8), "interpretation 8");
    EXPECT_FALSE(with(TIFFTAG_SAMPLESPERPIXEL, 60000).empty());
    EXPECT_FALSE(with(TIFFTAG_SAMPLESPERPIXEL, 0).empty());
    EXPECT_FALSE(with(TIFFTAG_STRIPOFFSETS, 4'000'000'000).empty());
    EXPECT_FALSE(with(TIFFTAG_STRIPOFFSETS, 130).empty()); // runs past the end
    EXPECT_FALSE(with(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE).empty());
    EXPECT_FALSE(with(TIFFTAG_COMPRESSION, COMPRESSION_ZSTD).empty());
}

TEST_F(TiffHostile, RefusesHugeTiles) {
    TiffByHand tiff;
    tiff.set(TIFFTAG_TILEWIDTH, 1U << 30);
    tiff.set(TIFFTAG_TILELENGTH, 1U << 30);
    EXPECT_FALSE(sentenceOf(write("a.tif", tiff.bytes())).empty());
}

TEST_F(TiffHostile, RefusesLoopsOfPages) {
    TiffByHand tiff;
    tiff.next = TiffByHand::firstPage;
    expectMentions(sentenceOf(write("a.tif", tiff.bytes())), "next page");
    tiff.next = 1'000'000;
    expectMentions(sentenceOf(write("a.tif", tiff.bytes())), "next page");
}

TEST_F(TiffHostile, TruncatedAnywhereItEndsInASentence) {
    const auto path = folder_ / "whole.tif";
    std::size_t shortest = 4;
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
        TiffPageOptions page;
        page.compression = compression;
        page.rowsPerStrip = 2;
        writeTiff(path, page, 3, ramp<std::uint16_t>(60));
        std::ifstream in(path, std::ios::binary);
        const std::string whole((std::istreambuf_iterator<char>(in)), {});
        const auto expected = loadAny(path).values<std::uint16_t>();
        for (std::size_t length = shortest++; length < whole.size(); length += 3) {
            const auto cut = write("cut.tif", whole.substr(0, length));
            try {
                EXPECT_EQ(loadAny(cut).values<std::uint16_t>(), expected)
                    << length; // unused bytes at the end
            } catch (const Error& error) {
                expectMentions(error.what(), "cut.tif");
            }
        }
    }
}

TEST_F(TiffHostile, RandomDamageNeverCrashes) {
    const auto path = folder_ / "whole.tif";
    std::mt19937 random(7);
    for (const int compression :
         {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_ZSTD}) {
        TiffPageOptions page;
        page.compression = compression;
        page.tile = compression == COMPRESSION_LZW ? 16 : 0;
        page.description = "ImageJ=1.53t\nimages=3\nslices=3\n";
        writeTiff(path, page, 3, ramp<std::uint16_t>(60));
        std::ifstream in(path, std::ios::binary);
        const std::string whole((std::istreambuf_iterator<char>(in)), {});
        ImportLimits limits;
        limits.maxBytes = 1U << 24;
        for (int trial = 0; trial < 150; ++trial) {
            auto damaged = whole;
            for (int i = 0; i < 3; ++i)
                damaged[4 + random() % (damaged.size() - 4)] = static_cast<char>(random());
            const auto file = write("damaged.tif", damaged);
            try {
                (void)loadAny(file, {}, limits);
            } catch (const Error& error) {
                expectMentions(error.what(), ": ");
            }
        }
    }
}

} // namespace
} // namespace voxsheet::import::testing
