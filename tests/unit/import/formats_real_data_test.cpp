// Public files, described in the README of the data folder; skipped where they are absent.
#include "formats_fixture.h"

#include <cmath>
#include <limits>

namespace voxsheet::import::testing {
namespace {

class FormatsRealData : public ::testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(data_ / "MANIFEST.tsv")) GTEST_SKIP() << "the data folder is absent";
    }
    [[nodiscard]] fs::path file(const std::string& name) const { return data_ / name; }

    fs::path data_ = VOXSHEET_DATA_DIR;
};

struct Summary {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double mean = 0.0;
};

Summary summary(const Loaded& loaded, int field = 0, int step = 0) {
    Summary result;
    visitScalar(loaded.meta().fields[static_cast<std::size_t>(field)].storedType, [&]<typename T>() {
        const auto values = loaded.values<T>(field, step);
        for (const auto value : values) {
            result.low = std::min(result.low, static_cast<double>(value));
            result.high = std::max(result.high, static_cast<double>(value));
            result.mean += static_cast<double>(value) / static_cast<double>(values.size());
        }
    });
    return result;
}

TEST_F(FormatsRealData, MetaImages) {
    const auto head = load(file("vol_FullHead/FullHead.mhd"));
    EXPECT_EQ(head.meta().grid.dims, glm::ivec3(256, 256, 94));
    EXPECT_EQ(head.meta().sourceType, ScalarType::I16);
    EXPECT_EQ(spacingWorld(head.meta().grid), glm::dvec3(0.9375, 0.9375, 1.5));
    int masked = 0; // bit 15 is a flag
    for (const auto value : head.values<short>())
        masked = std::max(masked, value & 0x7fff);
    EXPECT_EQ(masked, 4095);
    const auto frog = load(file("vol_frog/frog.mhd"));
    EXPECT_EQ(frog.meta().grid.dims, glm::ivec3(500, 470, 136));
    EXPECT_EQ(frog.meta().sourceType, ScalarType::U8);
    const auto small = load(file("vol_HeadMR/HeadMRVolume.mhd"));
    EXPECT_EQ(small.meta().grid.dims, glm::ivec3(48, 62, 42));
    EXPECT_EQ(spacingWorld(small.meta().grid), glm::dvec3(4));
    for (const auto* scan : {&head, &frog, &small}) // they name no sides
        EXPECT_FALSE(scan->meta().anatomical);
}

TEST_F(FormatsRealData, VolVisSlices) {
    const auto potential = load(file("vol_neghip/neghip.slc"));
    EXPECT_EQ(potential.meta().grid.dims, glm::ivec3(66));
    EXPECT_EQ(potential.meta().sourceType, ScalarType::U8);
    EXPECT_EQ(potential.values<unsigned char>()[0], 0); // 64^3 samples in a frame of zeros
    EXPECT_EQ(summary(potential).high, 255);
}

TEST_F(FormatsRealData, SlicesInManyFiles) {
    const auto head = load(file("vol_headsq_quarter/quarter.nhdr"));
    EXPECT_EQ(head.meta().grid.dims, glm::ivec3(64, 64, 93));
    EXPECT_EQ(spacingWorld(head.meta().grid), glm::dvec3(3.2, 3.2, 1.5));
    EXPECT_EQ(summary(head).low, 0);
    EXPECT_EQ(summary(head).high, 3926);
    EXPECT_EQ(head.header.files.size(), 94U);
}

TEST_F(FormatsRealData, OneBallInManyNrrdFiles) {
    const auto expected = load(file("odd_nrrd_pynrrd/BallBinary30x30x30.nii.gz")).values<short>();
    for (const auto* ending :
         {".nrrd", ".nhdr", "_gz.nrrd", "_bz2.nrrd", "_gz_lineskip.nrrd", "_gz_byteskip_minus_one.nrrd",
          "_byteskip_minus_one.nhdr", "_byteskip_minus_one_nifti.nhdr"}) {
        const auto ball = load(file(std::string("odd_nrrd_pynrrd/BallBinary30x30x30") + ending));
        EXPECT_EQ(ball.meta().grid.dims, glm::ivec3(30)) << ending;
        EXPECT_EQ(ball.meta().sourceType, ScalarType::I16) << ending;
        EXPECT_EQ(ball.values<short>(), expected) << ending;
        EXPECT_EQ(summary(ball).high, 257) << ending;
    }
    expectMentions(loadError(file("odd_nrrd_pynrrd/BallBinary30x30x30_byteskip_minus_five.nhdr")), "-5");
    // A NIfTI file taken as bare voxels, without a byte skip: 352 bytes too long, refused rather than
    // shifted.
    expectMentions(loadError(file("odd_nrrd_pynrrd/BallBinary30x30x30_nifti.nhdr")), "holds more");
}

TEST_F(FormatsRealData, NrrdFilesOfOtherShapes) {
    EXPECT_EQ(load(file("odd_nrrd_pynrrd/test1d_ascii.nrrd")).meta().grid.dims, glm::ivec3(27, 1, 1));
    EXPECT_EQ(load(file("odd_nrrd_pynrrd/test_customFields.nrrd")).values<unsigned char>()[26], 27);
    const auto flat = load(file("odd_nrrd_pynrrd/test2d_ascii.nrrd"));
    EXPECT_EQ(flat.meta().grid.dims, glm::ivec3(3, 9, 1));
    EXPECT_EQ(flat.values<unsigned short>()[26], 27);
    const auto four = load(file("odd_nrrd_pynrrd/test_simple4d_raw.nrrd"));
    EXPECT_NEAR(four.values<double>()[0], 0.76903426, 1e-8);
    EXPECT_EQ(spacingWorld(four.meta().grid), glm::dvec3(1.5, 1.5, 1.0));
}

TEST_F(FormatsRealData, EveryNiftiType) {
    for (const auto& type :
         {"int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"}) {
        const auto cube = load(file(std::string("vol_nifti_types/27_") + type + ".nii"));
        EXPECT_EQ(cube.meta().grid.dims, glm::ivec3(3)) << type;
        EXPECT_EQ(summary(cube).low, 0) << type;
        EXPECT_EQ(summary(cube).high, 26) << type;
    }
    EXPECT_EQ(load(file("vol_nifti_types/27_int8.nii")).meta().sourceType, ScalarType::I8);
    EXPECT_EQ(load(file("vol_nifti_types/27_uint64.nii")).meta().sourceType, ScalarType::U64);
    EXPECT_EQ(load(file("vol_nifti_types/complex64.nii")).meta().fields.size(), 2U);
    EXPECT_EQ(load(file("vol_nifti_types/rgba_4D.nii")).arrays.size(), 8U);
    EXPECT_EQ(load(file("vol_nifti_types/minimal_extended_hdr.nii")).meta().grid.dims, glm::ivec3(8, 8, 1));
    const auto expected = load(file("vol_nifti_types/minimal.nii")).values<unsigned char>();
    for (const auto* name :
         {"minimal.nii.gz", "minimal.hdr", "minimal.hdr.gz", "minimal.img", "minimal.img.gz", "minimal2.hdr"})
        EXPECT_EQ(load(file(std::string("vol_nifti_types/") + name)).values<unsigned char>(), expected)
            << name;
}

TEST_F(FormatsRealData, NiftiGeometryAndSeries) {
    const auto anatomical = load(file("vol_nibabel/anatomical.nii")).meta();
    EXPECT_EQ(anatomical.grid.dims, glm::ivec3(33, 41, 25));
    EXPECT_EQ(glm::dvec3(anatomical.grid.worldFromIndex[0]), glm::dvec3(-2, 0, 0));
    EXPECT_EQ(glm::dvec3(anatomical.grid.worldFromIndex[3]), glm::dvec3(32, -40, -16));
    const auto functional = load(file("vol_nibabel/functional.nii")).meta();
    EXPECT_EQ(functional.stepCount(), 20);
    EXPECT_NEAR(functional.times[1], 2.0, 1e-9);
    EXPECT_NEAR(functional.fields[0].valueScale, 0.0754069686, 1e-9);
    const auto second = load(file("vol_nibabel/example_nifti2.nii.gz")).meta();
    EXPECT_EQ(second.grid.dims, glm::ivec3(32, 20, 12));
    EXPECT_EQ(second.stepCount(), 2);
    const auto tilted = load(file("vol_nibabel/example4d.nii.gz")).meta();
    EXPECT_NEAR(tilted.grid.worldFromIndex[2].y, -0.355528, 1e-5); // as the header's srow_y
    const auto swapped = load(file("vol_nifti_types/zstat1.nii.gz"));
    EXPECT_EQ(swapped.meta().grid.dims, glm::ivec3(64, 64, 21));
    EXPECT_NEAR(summary(swapped).high, 18.5825, 1e-3);
}

TEST_F(FormatsRealData, ChargeDensityOfHydrogen) {
    const auto density = load(file("chg_H2/H2_CHGCAR"));
    EXPECT_EQ(density.meta().grid.dims, glm::ivec3(20, 20, 36));
    const auto range = summary(density);
    EXPECT_NEAR(range.low, 0.0238, 1e-4);
    EXPECT_NEAR(range.high, 33.3, 0.02);
    EXPECT_NEAR(range.mean, 2.0, 1e-3); // two electrons
    EXPECT_DOUBLE_EQ(density.meta().fields[0].valueScale, 1.0 / 16.0);
    EXPECT_EQ(density.meta().fields.size(), 1U);
    ASSERT_EQ(density.meta().crystal->atoms.size(), 2U);
    EXPECT_NEAR(density.meta().crystal->atoms[0].positionWorld.z, 4 * 0.409080, 1e-9);
}

TEST_F(FormatsRealData, GaussianCubeOfTenCarbonAtoms) {
    const auto density = load(file("cube_m4_total_density/m4_TotalDensity.cube"));
    const auto& meta = density.meta();
    EXPECT_EQ(meta.grid.dims, glm::ivec3(25, 22, 31));
    EXPECT_EQ(density.values<double>()[25 * 22], 2.88515e-10); // the file's second value: one step along z
    EXPECT_EQ(density.values<double>()[25], 2.09874e-10);      // its 32nd: one step along y
    ASSERT_EQ(meta.crystal->atoms.size(), 10U);
    EXPECT_EQ(meta.crystal->atoms[9].atomicNumber, 6);
    // Carbon atoms that share a bond: 1.40 Å, to the file's rounding.
    EXPECT_NEAR(glm::distance(meta.crystal->atoms[0].positionWorld, meta.crystal->atoms[1].positionWorld),
                1.40, 0.01);
    // In e/Bohr^3: integrates to the atoms' four valence electrons each, to the grid's coarseness.
    const double voxel = std::abs(glm::determinant(glm::dmat3(meta.grid.worldFromIndex)));
    const double electrons = summary(density).mean * 25 * 22 * 31 * voxel / std::pow(0.529177210903, 3);
    EXPECT_NEAR(electrons, 40.0, 0.2);
}

TEST_F(FormatsRealData, PerovskiteGrids) {
    for (const auto* name : {"AECCAR0", "AECCAR2", "LOCPOT"}) {
        const auto grid = load(file(std::string("chg_NaMgF3_perovskite/NaMgF3_") + name));
        EXPECT_EQ(grid.meta().grid.dims, glm::ivec3(40, 56, 40)) << name;
        EXPECT_EQ(grid.meta().crystal->atoms.size(), 20U) << name;
        const bool potential = std::string(name) == "LOCPOT";
        EXPECT_NEAR(grid.meta().fields[0].valueScale,
                    potential ? 1.0 : 1.0 / (5.540396 * 7.719289 * 5.376954), 1e-12)
            << name;
        EXPECT_LT(summary(grid).low, 0.0) << name; // the densities have small negatives
    }
}

TEST_F(FormatsRealData, VacancyMinusBulk) {
    const auto bulk = load(file("chg_CdTe_vacancy/bulk_vasp_gam/LOCPOT.gz"));
    const auto vacancy = load(file("chg_CdTe_vacancy/v_Cd_-2_vasp_gam/LOCPOT.gz"));
    EXPECT_EQ(bulk.meta().grid.dims, glm::ivec3(80));
    EXPECT_NEAR(std::min(summary(bulk).low, summary(vacancy).low), -101.6, 0.05);
    EXPECT_NEAR(std::max(summary(bulk).high, summary(vacancy).high), 8.05, 0.01);
    const auto a = bulk.values<double>();
    const auto b = vacancy.values<double>();
    double low = 0.0;
    double high = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        low = std::min(low, b[i] - a[i]);
        high = std::max(high, b[i] - a[i]);
        squares += (b[i] - a[i]) * (b[i] - a[i]);
    }
    EXPECT_NEAR(low, -32.6, 0.06);
    EXPECT_NEAR(high, 33.7, 0.06);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(a.size())), 1.86, 0.01);
}

TEST_F(FormatsRealData, BadFilesEndInASentence) {
    for (const auto* folder : {"bad_nifti_fuzz", "bad_lfs_pointers"})
        for (const auto& entry : fs::directory_iterator(file(folder))) {
            const auto message = loadError(entry.path());
            expectMentions(message, entry.path().filename().string());
            if (std::string(folder) == "bad_lfs_pointers") expectMentions(message, "Git LFS pointer");
        }
    expectMentions(loadError(file("vol_HeadMR/HeadMRVolume.raw")), "HeadMRVolume.mhd");
}

} // namespace
} // namespace voxsheet::import::testing
