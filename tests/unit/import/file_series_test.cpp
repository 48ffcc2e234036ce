// Several files as one dataset.
#include "import/child/file_series.h"
#include "nifti_bytes.h"
#include "process_fixture.h"
#include "store/volume_store.h"
#include "tiff_bytes.h"
#include "vtk_fixture.h"

namespace voxsheet::import::testing {
namespace {

class FileSeries : public FormatsTest {
protected:
    [[nodiscard]] Loaded loadSeries(const std::vector<fs::path>& files, const ImportOptions& options = {},
                                    const ImportLimits& limits = {}) const {
        std::vector<SeriesPart> parts;
        for (const auto& file : files) {
            const auto& reader = readers_.choose(file, options);
            parts.push_back({&reader, reader.readHeader(file, options, limits)});
        }
        Loaded loaded{combinedHeader(parts, limits), {}};
        const auto sink =
            applyOptions(loaded.header, options, [&](int field, int step, std::vector<std::byte>&& voxels) {
                EXPECT_EQ(voxels.size(), loaded.header.arrayBytes(field));
                EXPECT_TRUE(loaded.arrays.emplace(std::pair(field, step), std::move(voxels)).second);
            });
        double last = 0.0;
        (void)readSeries(parts, loaded.header, sink, [&](double fraction) {
            EXPECT_GE(fraction, last);
            last = fraction;
        });
        EXPECT_EQ(loaded.arrays.size(), loaded.meta().fields.size() * loaded.meta().times.size());
        return loaded;
    }
    [[nodiscard]] std::string refused(const std::vector<fs::path>& files,
                                      const ImportLimits& limits = {}) const {
        try {
            (void)loadSeries(files, {}, limits);
        } catch (const Error& error) {
            return error.what();
        }
        ADD_FAILURE() << "the series was read";
        return {};
    }

    /// 2 x 3 x nz bytes that begin with `first`.
    [[nodiscard]] fs::path volume(const std::string& name, int nz, char first,
                                  const std::string& more = "") const {
        std::string voxels;
        for (char i = 0; i < 6 * nz; ++i)
            voxels += static_cast<char>(first + i);
        return write(name, "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 " + std::to_string(nz) +
                               "\nencoding: raw\n" + more + "\n" + voxels);
    }

    ReaderRegistry readers_;
};

TEST_F(FileSeries, NumberedTiffFilesAreSlicesOfOneVolume) {
    const auto values = ramp<std::uint16_t>(5 * 4 * 3);
    std::vector<fs::path> files;
    for (std::size_t slice = 0; slice < 3; ++slice) {
        files.push_back(folder_ / ("slice_" + std::to_string(slice) + ".tif"));
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(20 * slice);
        writeTiff(files.back(), {}, 1, std::vector<std::uint16_t>(begin, begin + 20),
                  slice == 1 ? "wb" : "w8");
    }
    const auto loaded = loadSeries(files);
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 4, 3));
    EXPECT_EQ(loaded.meta().stepCount(), 1);
    EXPECT_EQ(loaded.values<std::uint16_t>(), values);
    EXPECT_EQ(loaded.header.files.size(), 3U);
    EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(1));

    ImportOptions options;
    options.spacing = glm::dvec3(1, 1, 2.5);
    options.flip = glm::bvec3(false, false, true);
    const auto moved = loadSeries(files, options);
    EXPECT_EQ(spacingWorld(moved.meta().grid), glm::dvec3(1, 1, 2.5));
    EXPECT_EQ(moved.values<std::uint16_t>(), values);
    EXPECT_EQ(glm::dvec3(moved.meta().grid.worldFromIndex[2]), glm::dvec3(0, 0, -2.5));
}

TEST_F(FileSeries, ChannelsOfSlicesAreFields) {
    const auto values = ramp<std::uint8_t>(20 * 3 * 2);
    TiffPageOptions page;
    page.samples = 3;
    page.photometric = PHOTOMETRIC_RGB;
    std::vector<fs::path> files;
    for (std::ptrdiff_t slice = 0; slice < 2; ++slice) {
        files.push_back(folder_ / ("rgb" + std::to_string(slice) + ".tif"));
        writeTiff(files.back(), page, 1,
                  std::vector<std::uint8_t>(values.begin() + 60 * slice, values.begin() + 60 * (slice + 1)));
    }
    const auto loaded = loadSeries(files);
    ASSERT_EQ(loaded.meta().fields.size(), 3U);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto plane = loaded.values<std::uint8_t>(static_cast<int>(channel));
        for (std::size_t i = 0; i < plane.size(); ++i)
            ASSERT_EQ(plane[i], values[3 * i + channel]);
    }
}

TEST_F(FileSeries, SlicesLieWhereTheirFilesSay) {
    std::vector<fs::path> files;
    for (int slice = 0; slice < 3; ++slice)
        files.push_back(volume("s" + std::to_string(slice), 1, static_cast<char>(6 * slice),
                               "space: RAS\nspace directions: (2,0,0) (0,2,0) (0,0,1)\nspace origin: (5,6," +
                                   std::to_string(7 - 3 * slice) + ")\n"));
    const auto loaded = loadSeries(files);
    EXPECT_EQ(glm::dvec3(loaded.meta().grid.worldFromIndex[2]), glm::dvec3(0, 0, -3));
    EXPECT_EQ(glm::dvec3(loaded.meta().grid.worldFromIndex[3]), glm::dvec3(5, 6, 7));
    EXPECT_EQ(loaded.values<unsigned char>()[17], 17);
    expectMentions(refused({files[0], files[2], files[1]}), "not as far");
}

TEST_F(FileSeries, VolumesAreTimeSteps) {
    const auto loaded = loadSeries({volume("t0", 2, 0), volume("t1", 2, 20), volume("t2", 2, 40)});
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(2, 3, 2));
    EXPECT_EQ(loaded.meta().times, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(loaded.values<unsigned char>(0, 0)[11], 11);
    EXPECT_EQ(loaded.values<unsigned char>(0, 2)[0], 40);
}

TEST_F(FileSeries, FilesThatDifferAreNamed) {
    const auto first = volume("a", 2, 0);
    expectMentions(refused({first, volume("b", 3, 0)}), "2 x 3 x 3");
    expectMentions(refused({first, volume("c", 2, 0, "spacings: 1 1 2\n")}), "another spacing");
    const auto other = write("d", "NRRD0004\ntype: int8\ndimension: 3\nsizes: 2 3 2\nencoding: raw\n\n" +
                                      std::string(12, '\1'));
    const auto text = refused({first, other});
    expectMentions(text, "i8");
    expectMentions(text, "/d:");
    ImportLimits limits;
    limits.maxBytes = 30;
    expectMentions(refused({first, volume("e", 2, 0), volume("f", 2, 0)}, limits), "more than the limit");
}

} // namespace

class FileSeriesProcess : public ProcessTest {};

TEST_F(FileSeriesProcess, GoThroughTheImporterAndTheStore) {
    const std::vector<std::filesystem::path> files{smallVolume("t0.nrrd"), smallVolume("t1.nrrd")};
    const auto key = runImport(settings_, {files, {}}).key;
    const store::VolumeStore store(settings_.storeFolder);
    ASSERT_NE(store.open(key), nullptr);
    EXPECT_EQ(store.open(key)->meta()->times.size(), 2U);
    EXPECT_EQ(runImport(settings_, {files, {}}).key, key);
    EXPECT_NE(runImport(settings_, {{files[1], files[0]}, {}}).key, key);
    try {
        (void)runImport(settings_, {{files[0], folder_ / "missing.nrrd"}, {}});
        ADD_FAILURE() << "a missing file was read";
    } catch (const NotFound& error) {
        testing::expectMentions(error.what(), "missing.nrrd");
    }
}

} // namespace voxsheet::import::testing
