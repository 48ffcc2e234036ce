#include "tiff_bytes.h"
#include "vtk_fixture.h"

namespace voxsheet::import::testing {
namespace {

class TiffStacks : public FormatsTest {
protected:
    [[nodiscard]] fs::path path() const { return folder_ / "stack.tif"; }

    template <typename T>
    [[nodiscard]] Loaded roundTrip(const TiffPageOptions& page, int pages, const std::vector<T>& values,
                                   const char* mode = "w") const {
        writeTiff(path(), page, pages, values, mode);
        return loadAny(path());
    }
    /// Three pages of 5 x 4 bytes with a description.
    [[nodiscard]] Loaded described(const std::string& description, int pages) const {
        TiffPageOptions page;
        page.description = description;
        return roundTrip(page, pages, ramp<std::uint8_t>(20 * static_cast<std::size_t>(pages)));
    }
    [[nodiscard]] std::string refused(const std::string& description, int pages) const {
        TiffPageOptions page;
        page.description = description;
        writeTiff(path(), page, pages, ramp<std::uint8_t>(20 * static_cast<std::size_t>(pages)));
        return sentenceOf(path());
    }
};

bool hasNote(const Loaded& loaded, const std::string& words) {
    const auto& notes = loaded.meta().notes;
    return std::any_of(notes.begin(), notes.end(),
                       [&](const auto& note) { return note.find(words) != std::string::npos; });
}

template <typename T>
class TiffTypes : public TiffStacks {};
using Scalars = ::testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                                 std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(TiffTypes, Scalars);

TYPED_TEST(TiffTypes, PagesAreSlicesInEitherByteOrderAndBigTiff) {
    const auto values = ramp<TypeParam>(60);
    for (const char* mode : {"wl", "wb", "w8"}) {
        const auto loaded = this->roundTrip({}, 3, values, mode);
        EXPECT_EQ(loaded.meta().format, "tiff");
        EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 4, 3));
        EXPECT_EQ(loaded.meta().fields.size(), 1U);
        EXPECT_EQ(loaded.meta().fields[0].name, "value");
        EXPECT_EQ(loaded.template values<TypeParam>(), values) << mode;
    }
}

TEST_F(TiffStacks, EveryLayoutAndCompression) {
    const auto values = ramp<std::uint16_t>(35 * 20 * 3 * 2);
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                                  COMPRESSION_PACKBITS, COMPRESSION_ZSTD, COMPRESSION_LZMA})
        for (const bool planar : {false, true})
            for (const std::uint32_t tile : {0U, 16U}) {
                TiffPageOptions page{35, 20, 3, compression, PHOTOMETRIC_RGB, planar, tile, 7, "", {}};
                const auto loaded = roundTrip(page, 2, values);
                ASSERT_EQ(loaded.meta().fields.size(), 3U);
                for (int channel = 0; channel < 3; ++channel) {
                    EXPECT_EQ(loaded.meta().fields[static_cast<std::size_t>(channel)].name,
                              std::string("rgb").substr(static_cast<std::size_t>(channel), 1));
                    const auto plane = loaded.values<std::uint16_t>(channel);
                    std::size_t different = 0;
                    for (std::size_t i = 0; i < plane.size(); ++i)
                        if (plane[i] != values[3 * i + static_cast<std::size_t>(channel)]) ++different;
                    EXPECT_EQ(different, 0U) << compression << planar << tile;
                }
            }
}

TEST_F(TiffStacks, RowsRiseAlongYInARightHandedFrame) {
    const auto loaded = roundTrip({}, 3, ramp<std::uint8_t>(60));
    EXPECT_EQ(loaded.meta().grid.worldFromIndex, glm::dmat4(1.0));
    EXPECT_EQ(loaded.meta().lengthUnit, "");
    EXPECT_TRUE(hasNote(loaded, "Rows go along y"));
    EXPECT_EQ(roundTrip({}, 1, ramp<std::uint8_t>(20)).meta().grid.dims, glm::ivec3(5, 4, 1));
}

TEST_F(TiffStacks, ExtraSamplesAndPalettes) {
    TiffPageOptions page;
    page.samples = 4;
    page.photometric = PHOTOMETRIC_RGB;
    page.more = [](TIFF* tiff) {
        const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
    };
    const auto values = ramp<std::uint8_t>(80);
    const auto colour = roundTrip(page, 1, values);
    EXPECT_EQ(colour.meta().fields[3].name, "a");
    EXPECT_EQ(colour.values<std::uint8_t>(0)[7], values[28]); // not multiplied by alpha

    std::array<std::vector<std::uint16_t>, 3> map;
    for (std::size_t i = 0; i < 256; ++i) {
        map[0].push_back(static_cast<std::uint16_t>(257 * i));
        map[1].push_back(static_cast<std::uint16_t>(257 * (255 - i)));
        map[2].push_back(static_cast<std::uint16_t>(257 * (i / 2)));
    }
    TiffPageOptions indexed;
    indexed.photometric = PHOTOMETRIC_PALETTE;
    indexed.more = [&](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_COLORMAP, map[0].data(), map[1].data(), map[2].data());
    };
    const auto indices = ramp<std::uint8_t>(40);
    const auto palette = roundTrip(indexed, 2, indices);
    ASSERT_EQ(palette.meta().fields.size(), 3U);
    EXPECT_EQ(palette.values<std::uint8_t>(0), indices);
    EXPECT_EQ(palette.values<std::uint8_t>(1)[33], 255 - indices[33]);
    EXPECT_EQ(palette.values<std::uint8_t>(2)[33], indices[33] / 2);
    indexed.description = "ImageJ=1.53t\nimages=2\nslices=2\n";
    const auto display = roundTrip(indexed, 2, indices);
    ASSERT_EQ(display.meta().fields.size(), 1U);
    EXPECT_EQ(display.values<std::uint8_t>(), indices);
    EXPECT_TRUE(hasNote(display, "palette"));
}

TEST_F(TiffStacks, ResolutionTagsGiveMillimetres) {
    TiffPageOptions page;
    page.more = [](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_CENTIMETER);
        TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 20.0);
        TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 40.0);
    };
    const auto loaded = roundTrip(page, 2, ramp<std::uint8_t>(40));
    EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(0.5, 0.25, 0.375));
    EXPECT_EQ(loaded.meta().lengthUnit, "mm");
    EXPECT_TRUE(hasNote(loaded, "20 x 40 pixels per cm"));
    EXPECT_TRUE(hasNote(loaded, "distance of its slices"));
}

TEST_F(TiffStacks, ImageJHyperstacks) {
    TiffPageOptions page;
    page.description = "ImageJ=1.53t\nimages=12\nchannels=2\nslices=3\nframes=2\nhyperstack=true\n"
                       "spacing=-0.5\nunit=\\u00B5m\nfinterval=2.5\n";
    page.more = [](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
        TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 8.0);
        TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 8.0);
    };
    const auto values = ramp<std::uint16_t>(240);
    const auto loaded = roundTrip(page, 12, values);
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 4, 3));
    EXPECT_EQ(loaded.meta().times, (std::vector<double>{0.0, 2.5}));
    EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(0.125, 0.125, 0.5));
    EXPECT_EQ(loaded.meta().lengthUnit, "µm");
    ASSERT_EQ(loaded.meta().fields.size(), 2U);
    EXPECT_EQ(loaded.meta().fields[1].name, "channel 2");
    for (std::size_t frame = 0; frame < 2; ++frame)
        for (std::size_t slice = 0; slice < 3; ++slice)
            for (std::size_t channel = 0; channel < 2; ++channel) {
                const auto pageIndex = (frame * 3 + slice) * 2 + channel;
                const auto volume =
                    loaded.values<std::uint16_t>(static_cast<int>(channel), static_cast<int>(frame));
                EXPECT_EQ(volume[slice * 20 + 11], values[pageIndex * 20 + 11]);
            }
}

TEST_F(TiffStacks, ImageJCalibrationOfValues) {
    const auto loaded = described("ImageJ=1.53t\nimages=2\ncf=0\nc0=-32768.0\nc1=2.0\nvunit=HU\n", 2);
    EXPECT_EQ(loaded.meta().fields[0].valueOffset, -32768.0);
    EXPECT_EQ(loaded.meta().fields[0].valueScale, 2.0);
    EXPECT_EQ(loaded.meta().fields[0].unit, "HU");
    EXPECT_EQ(loaded.meta().grid.dims.z, 2);
}

TEST_F(TiffStacks, OmeOrderAndLengths) {
    const auto loaded = described(
        R"(<?xml version="1.0"?><OME><Image><Pixels ID="P" DimensionOrder="XYZCT" SizeC="2" SizeT="1" SizeX="5" )"
        R"(SizeY="4" SizeZ="3" PhysicalSizeX="0.25" PhysicalSizeY="0.5" PhysicalSizeZ="2"></Pixels></Image></OME>)",
        6);
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 4, 3));
    EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(0.25, 0.5, 2));
    EXPECT_EQ(loaded.meta().lengthUnit, "µm");
    const auto values = ramp<std::uint8_t>(120);
    EXPECT_EQ(loaded.values<std::uint8_t>(1), std::vector<std::uint8_t>(values.begin() + 60, values.end()));
    expectMentions(refused(R"(<OME><Pixels DimensionOrder="XYZCT" SizeC="2" SizeT="1" SizeZ="3">)", 3),
                   "2 channels x 3 slices x 1 frames");
    expectMentions(refused(R"(<OME><Pixels DimensionOrder="XYZZT" SizeC="1">)", 3), "DimensionOrder");
}

TEST_F(TiffStacks, RefusesDescriptionsThatDoNotFit) {
    const std::string top = "ImageJ=1.53t\n";
    expectMentions(refused(top + "images=4\n", 3), "4 images, and it has 3 pages");
    expectMentions(refused(top + "images=500\n", 1), "500 images, and it has 1 page");
    expectMentions(refused(top + "channels=2\n", 3), "2 channels");
    expectMentions(refused(top + "images=3\nslices=2\n", 3), "2 slices");
    for (const auto* line : {"slices=0\n", "slices=-3\n", "frames=x\n", "channels=4294967297\n",
                             "channels=9223372036854775807\nframes=9223372036854775807\n", "spacing=nan\n",
                             "finterval=x\n", "images=\n", "slices=1e400\n"})
        EXPECT_FALSE(refused(top + line, 3).empty()) << line;
}

TEST_F(TiffStacks, LeavesThumbnailsOutAndRefusesUnequalPages) {
    TIFF* const tiff = TIFFOpen(path().c_str(), "w");
    const auto values = ramp<std::uint8_t>(64);
    writeTiffPage(tiff, {}, values.data());
    TiffPageOptions small;
    small.width = 2;
    small.height = 2;
    small.more = [](TIFF* handle) { TIFFSetField(handle, TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE); };
    writeTiffPage(tiff, small, values.data());
    writeTiffPage(tiff, {}, values.data() + 20);
    TIFFClose(tiff);
    const auto loaded = loadAny(path());
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 4, 2));
    EXPECT_EQ(loaded.values<std::uint8_t>()[25], values[25]);
    EXPECT_TRUE(hasNote(loaded, "thumbnails"));

    TIFF* const unequal = TIFFOpen(path().c_str(), "w");
    writeTiffPage(unequal, {}, values.data());
    small.more = {};
    writeTiffPage(unequal, small, values.data());
    TIFFClose(unequal);
    expectMentions(sentenceOf(path()), "page 2 is 2 x 2 u8, the pages before it are 5 x 4 u8");
}

TEST_F(TiffStacks, HoldsTheLimits) {
    writeTiff(path(), {}, 3, ramp<std::uint16_t>(60));
    ImportLimits limits;
    limits.maxBytes = 119;
    EXPECT_THROW((void)loadAny(path(), {}, limits), LimitExceeded);
    limits.maxBytes = 120;
    EXPECT_NO_THROW((void)loadAny(path(), {}, limits));
}

} // namespace
} // namespace voxsheet::import::testing
