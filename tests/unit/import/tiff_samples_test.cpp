// Samples of TIFF files that are no whole bytes, floats of 16 bits, and pictures that are turned.
#include "import/tiff/packed_samples.h"
#include "tiff_bytes.h"
#include "vtk_fixture.h"

#include <cmath>

namespace voxsheet::import::testing {
namespace {

/// Highest bit first; every row of `perRow` values begins on a whole byte.
std::string packed(const std::vector<unsigned>& values, int bits, std::size_t perRow) {
    std::string bytes;
    unsigned filled = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % perRow == 0) filled = 0;
        for (int bit = bits - 1; bit >= 0; --bit, ++filled) {
            if (filled % 8 == 0) bytes += '\0';
            const unsigned one = (values[i] >> static_cast<unsigned>(bit)) & 1U;
            bytes.back() =
                static_cast<char>(static_cast<unsigned char>(bytes.back()) | (one << (7 - filled % 8)));
        }
    }
    return bytes;
}

struct PackedPage {
    int bits = 1;
    int format = SAMPLEFORMAT_UINT;
    std::uint32_t width = 5;
    std::uint32_t height = 4;
    std::uint32_t tile = 0;
    int samples = 1;
    int photometric = PHOTOMETRIC_MINISBLACK;
    int compression = COMPRESSION_NONE;
    int fillOrder = FILLORDER_MSB2LSB;
    std::function<void(TIFF*)> more;
};

class TiffSamples : public FormatsTest {
protected:
    /// `blocks`: one strip for the whole page, or its tiles.
    [[nodiscard]] fs::path writePacked(const PackedPage& page, std::vector<std::string> blocks,
                                       const char* mode = "w") const {
        const auto path = folder_ / "packed.tif";
        TIFF* const tiff = TIFFOpen(path.c_str(), mode);
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, page.width);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, page.height);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, page.samples);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, page.bits);
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, page.format);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, page.photometric);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, page.compression);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        TIFFSetField(tiff, TIFFTAG_FILLORDER, page.fillOrder);
        if (page.tile != 0) {
            TIFFSetField(tiff, TIFFTAG_TILEWIDTH, page.tile);
            TIFFSetField(tiff, TIFFTAG_TILELENGTH, page.tile);
        } else {
            TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, page.height);
        }
        if (page.more) page.more(tiff);
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            auto& block = blocks[i];
            const auto size = static_cast<tmsize_t>(block.size());
            if (page.tile != 0)
                EXPECT_EQ(TIFFWriteEncodedTile(tiff, static_cast<std::uint32_t>(i), block.data(), size),
                          size);
            else
                EXPECT_EQ(TIFFWriteEncodedStrip(tiff, static_cast<std::uint32_t>(i), block.data(), size),
                          size);
        }
        TIFFClose(tiff);
        return path;
    }
};

std::vector<unsigned> spread(std::size_t count, int bits) {
    std::vector<unsigned> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(static_cast<unsigned>(i * 2654435761U >> 7U) &
                         ((1U << static_cast<unsigned>(bits)) - 1U));
    return values;
}

TEST_F(TiffSamples, OfAnyNumberOfBitsInEveryLayout) {
    for (const int bits : {1, 2, 3, 4, 6, 10, 12, 14})
        for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE})
            for (const char* mode : {"wl", "wb", "w8"}) {
                PackedPage page;
                page.bits = bits;
                page.compression = compression;
                const auto values = spread(20, bits);
                const auto loaded = loadAny(writePacked(page, {packed(values, bits, 5)}, mode));
                EXPECT_EQ(loaded.meta().sourceType, bits <= 8 ? ScalarType::U8 : ScalarType::U16) << bits;
                visitScalar(loaded.meta().sourceType, [&]<typename T>() {
                    const auto read = loaded.values<T>();
                    EXPECT_EQ(std::vector<unsigned>(read.begin(), read.end()), values) << bits << mode;
                });
            }
}

TEST_F(TiffSamples, PackedTilesAndInterleavedChannels) {
    PackedPage page;
    page.bits = 12;
    page.samples = 3;
    page.photometric = PHOTOMETRIC_RGB;
    page.width = 20;
    page.height = 16;
    page.tile = 16;
    const auto values = spread(20 * 16 * 3, 12);
    std::vector<std::string> tiles;
    for (const std::size_t left : {0U, 16U}) {
        std::vector<unsigned> tile(16 * 16 * 3, 0U);
        for (std::size_t y = 0; y < 16; ++y)
            for (std::size_t x = 0; x < 16 && left + x < 20; ++x)
                for (std::size_t s = 0; s < 3; ++s)
                    tile[(y * 16 + x) * 3 + s] = values[(y * 20 + left + x) * 3 + s];
        tiles.push_back(packed(tile, 12, 16 * 3));
    }
    const auto loaded = loadAny(writePacked(page, tiles));
    ASSERT_EQ(loaded.meta().fields.size(), 3U);
    for (std::size_t s = 0; s < 3; ++s) {
        const auto plane = loaded.values<unsigned short>(static_cast<int>(s));
        for (std::size_t i = 0; i < plane.size(); ++i)
            ASSERT_EQ(plane[i], values[3 * i + s]) << s << " " << i;
    }
}

TEST_F(TiffSamples, SignedBitsFaxAndTheOtherBitOrder) {
    PackedPage page;
    page.bits = 4;
    page.format = SAMPLEFORMAT_INT;
    const auto values = spread(20, 4);
    const auto loaded = loadAny(writePacked(page, {packed(values, 4, 5)}));
    EXPECT_EQ(loaded.meta().sourceType, ScalarType::I8);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(loaded.values<signed char>()[i], static_cast<int>(values[i]) - (values[i] >= 8 ? 16 : 0));

    const auto mask = spread(20, 1);
    for (const int compression : {COMPRESSION_CCITTFAX4, COMPRESSION_PACKBITS}) {
        PackedPage fax;
        fax.compression = compression;
        fax.photometric = PHOTOMETRIC_MINISWHITE;
        for (const int order : {FILLORDER_MSB2LSB, FILLORDER_LSB2MSB}) {
            fax.fillOrder = order;
            const auto read = loadAny(writePacked(fax, {packed(mask, 1, 5)})).values<unsigned char>();
            EXPECT_EQ(std::vector<unsigned>(read.begin(), read.end()), mask) << compression << " " << order;
        }
    }
}

TEST_F(TiffSamples, PalettesOfFewColours) {
    std::array<std::vector<std::uint16_t>, 3> map;
    for (unsigned i = 0; i < 16; ++i)
        for (unsigned c = 0; c < 3; ++c)
            map[c].push_back(static_cast<std::uint16_t>((i * 16 + c) << 8U));
    PackedPage page;
    page.bits = 4;
    page.photometric = PHOTOMETRIC_PALETTE;
    page.more = [&](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_COLORMAP, map[0].data(), map[1].data(), map[2].data());
    };
    const auto indices = spread(20, 4);
    const auto loaded = loadAny(writePacked(page, {packed(indices, 4, 5)}));
    ASSERT_EQ(loaded.meta().fields.size(), 3U);
    for (unsigned c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < indices.size(); ++i)
            EXPECT_EQ(loaded.values<unsigned char>(static_cast<int>(c))[i], indices[i] * 16 + c);
}

TEST_F(TiffSamples, FloatsOf16BitsBecomeFloats) {
    // 1, -2, the largest, the smallest, zeros, infinity: IEEE 754, binary16.
    const std::vector<unsigned short> halves{0x3c00, 0xc000, 0x7bff, 0x0001, 0x0000, 0x8000, 0x7c00, 0x3555};
    const std::vector<float> expected{1.0F, -2.0F, 65504.0F,  0x1p-24F,
                                      0.0F, -0.0F, HUGE_VALF, 0.333251953125F};
    PackedPage page;
    page.bits = 16;
    page.format = SAMPLEFORMAT_IEEEFP;
    page.width = 8;
    page.height = 1;
    for (const char* mode : {"wl", "wb"}) {
        const auto loaded = loadAny(writePacked(page, {bytesOf(halves)}, mode));
        EXPECT_EQ(loaded.meta().sourceType, ScalarType::F32);
        EXPECT_EQ(loaded.values<float>(), expected) << mode;
    }
    EXPECT_TRUE(std::isnan(floatFromHalf(0x7e00)));
}

TEST_F(TiffSamples, OrientationPlacesRowsAndColumns) {
    // Where the first sample, its neighbour in the row and its neighbour in the column lie: 5 columns and 4
    // rows.
    using V = glm::dvec3;
    const std::vector<std::array<V, 3>> expected{
        {V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)}, {V(4, 0, 0), V(3, 0, 0), V(4, 1, 0)},
        {V(4, 3, 0), V(3, 3, 0), V(4, 2, 0)}, {V(0, 3, 0), V(1, 3, 0), V(0, 2, 0)},
        {V(0, 0, 0), V(0, 1, 0), V(1, 0, 0)}, {V(3, 0, 0), V(3, 1, 0), V(2, 0, 0)},
        {V(3, 4, 0), V(3, 3, 0), V(2, 4, 0)}, {V(0, 4, 0), V(0, 3, 0), V(1, 4, 0)}};
    const auto values = ramp<std::uint8_t>(20);
    for (int orientation = 1; orientation <= 8; ++orientation) {
        TiffPageOptions page;
        page.more = [&](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_ORIENTATION, orientation); };
        writeTiff(folder_ / "turned.tif", page, 1, values);
        const auto loaded = loadAny(folder_ / "turned.tif");
        EXPECT_EQ(loaded.values<std::uint8_t>(), values) << "the numbers stay in their order";
        const auto at = [&](double i, double j) {
            return V(loaded.meta().grid.worldFromIndex * glm::dvec4(i, j, 0, 1));
        };
        const auto& [first, right, down] = expected[static_cast<std::size_t>(orientation - 1)];
        EXPECT_EQ(at(0, 0), first) << orientation;
        EXPECT_EQ(at(1, 0), right) << orientation;
        EXPECT_EQ(at(0, 1), down) << orientation;
    }
}

} // namespace
} // namespace voxsheet::import::testing
