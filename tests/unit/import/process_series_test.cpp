// Several files as one dataset, through the real importer.
#include "process_fixture.h"

namespace voxsheet::import {
namespace {

class ProcessSeries : public ProcessTest {
protected:
    /// `sizes` e.g. "4 3 1"; every sample is `first` plus its index.
    [[nodiscard]] std::filesystem::path volume(const std::string& name, const std::string& sizes, int count,
                                               int first, const std::string& more = {}) const {
        std::string text =
            "NRRD0004\ntype: uint8\ndimension: 3\nsizes: " + sizes + "\n" + more + "encoding: raw\n\n";
        for (int i = 0; i < count; ++i)
            text += static_cast<char>(first + i);
        return write(name, text);
    }
    /// The message of the Error that the import ends with; empty if it does not.
    [[nodiscard]] std::string failureOf(const std::vector<std::filesystem::path>& files,
                                        const nlohmann::json& options = {}) const {
        try {
            (void)runImport(settings_, {files, options});
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
};

TEST_F(ProcessSeries, SlicesMakeAVolumeInTheirOrder) {
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < 5; ++i)
        files.push_back(
            volume("s" + std::to_string(i) + ".nrrd", "4 3 1", 12, 40 - 10 * i, "spacings: 0.5 0.5 2\n"));
    double last = 0.0;
    const auto key = runImport(settings_, {files, {}}, [&](double fraction) {
                         EXPECT_GE(fraction, last);
                         last = fraction;
                     }).key;
    EXPECT_EQ(last, 1.0);
    const auto entry = store::VolumeStore(settings_.storeFolder).open(key);
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(4, 3, 5));
    EXPECT_EQ(entry->meta()->stepCount(), 1);
    EXPECT_EQ(spacingWorld(entry->meta()->grid), glm::dvec3(0.5, 0.5, 2.0));
    for (int z = 0; z < 5; ++z)
        EXPECT_EQ(entry->readValue({key, 0, 0, 0}, {3, 2, z}), 40.0 - 10.0 * z + 11.0) << z;
    ASSERT_FALSE(entry->meta()->notes.empty());
    EXPECT_EQ(entry->meta()->notes.front().find("5 files are the slices"), 0U);
    // Another order is another dataset, and a changed member, too.
    EXPECT_NE(runImport(settings_, {{files.rbegin(), files.rend()}, {}}).key, key);
    files[2] = volume("s2.nrrd", "4 3 1", 12, 99, "spacings: 0.5 0.5 2\n");
    EXPECT_NE(runImport(settings_, {files, {}}).key, key);
}

TEST_F(ProcessSeries, SlabsMakeAVolumeWhenAskedTo) {
    const auto key =
        runImport(settings_, {{volume("a.nrrd", "4 3 2", 24, 0), volume("b.nrrd", "4 3 2", 24, 24)},
                              {{"series", "stack"}}})
            .key;
    const auto entry = store::VolumeStore(settings_.storeFolder).open(key);
    EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(4, 3, 4));
    EXPECT_EQ(entry->readValue({key, 0, 0, 0}, {0, 0, 2}), 24.0);
    EXPECT_EQ(entry->readValue({key, 0, 0, 0}, {3, 2, 3}), 47.0);
}

TEST_F(ProcessSeries, SlabsLieWhereTheySay) {
    const auto slab = [&](const std::string& name, double z) {
        return volume(name, "4 3 2", 24, 0,
                      "space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,3)\nspace origin: (0,0," +
                          std::to_string(z) + ")\n");
    };
    const auto key =
        runImport(settings_, {{slab("a.nrrd", 10), slab("b.nrrd", 16)}, {{"series", "stack"}}}).key;
    EXPECT_EQ(spacingWorld(store::VolumeStore(settings_.storeFolder).open(key)->meta()->grid).z, 3.0);
    EXPECT_NE(failureOf({slab("c.nrrd", 10), slab("d.nrrd", 20)}, {{"series", "stack"}}).find("slab"),
              std::string::npos);
}

TEST_F(ProcessSeries, SlicesAreStepsWhenAskedTo) {
    const auto key =
        runImport(settings_, {{volume("p.nrrd", "4 3 1", 12, 0), volume("q.nrrd", "4 3 1", 12, 50)},
                              {{"series", "steps"}}})
            .key;
    const auto entry = store::VolumeStore(settings_.storeFolder).open(key);
    EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(4, 3, 1));
    EXPECT_EQ(entry->meta()->stepCount(), 2);
    EXPECT_EQ(entry->readValue({key, 0, 1, 0}, {3, 2, 0}), 61.0);
}

TEST_F(ProcessSeries, VolumesAreStepsOfTime) {
    const std::vector files{volume("t1.nrrd", "4 3 2", 24, 0), volume("t2.nrrd", "4 3 2", 24, 100),
                            volume("t10.nrrd", "4 3 2", 24, 200)};
    const auto key = runImport(settings_, {files, {}}).key;
    const auto entry = store::VolumeStore(settings_.storeFolder).open(key);
    EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(4, 3, 2));
    EXPECT_EQ(entry->meta()->times, (std::vector<double>{0.0, 1.0, 2.0}));
    for (int step = 0; step < 3; ++step)
        EXPECT_EQ(entry->readValue({key, 0, step, 0}, {1, 0, 0}), 100.0 * step + 1.0);
    EXPECT_NE(runImport(settings_, {files, {{"series", "stack"}}}).key, key);
}

TEST_F(ProcessSeries, WhatDoesNotFitIsNamed) {
    const auto first = volume("a.nrrd", "4 3 2", 24, 0);
    const auto wide = volume("wide.nrrd", "6 2 2", 24, 0);
    EXPECT_NE(failureOf({first, wide}).find("wide.nrrd"), std::string::npos);
    EXPECT_NE(failureOf({first, wide}).find("6 x 2 x 2"), std::string::npos);
    EXPECT_NE(failureOf({first, volume("thin.nrrd", "4 3 1", 12, 0)}).find("thin.nrrd"), std::string::npos);
    EXPECT_NE(failureOf({first, volume("spaced.nrrd", "4 3 2", 24, 0, "spacings: 1 1 3\n")}).find("spacing"),
              std::string::npos);
    EXPECT_NE(
        failureOf({first, write("cut.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: "
                                            "raw\n\nabc")})
            .find("cut.nrrd"),
        std::string::npos);
    EXPECT_NE(failureOf({first, folder_ / "absent.nrrd"}).find("absent.nrrd"), std::string::npos);
    EXPECT_NE(failureOf({first}, {{"series", "pile"}}).find("series"), std::string::npos);
}

} // namespace
} // namespace voxsheet::import
