// Every file of the public data: a volume that equals what an independent reader finds in it, or a refusal.
// Where the data's README states dims or a range, it stands here too. Skipped where the data are absent.
#include "../vtk_fixture.h"
#include "plain_readers.h"

#include <functional>
#include <ostream>
#include <set>

namespace voxsheet::import::testing {
namespace {

struct RealFile {
    const char* path;
    PlainVolume (*read)(const fs::path&);
    glm::ivec3 dims;
    double low = 0.0; ///< stored numbers of the first field and step; low > high: the README says nothing
    double high = -1.0;
    double tolerance = 0.0; ///< half a unit of the last digit that the README gives
};

std::ostream& operator<<(std::ostream& out, const RealFile& file) { return out << file.path; }

const std::vector<RealFile>& realFiles() {
    using P = glm::ivec3;
    static const std::vector<RealFile> files{
        {"vol_FullHead/FullHead.mhd", plainMetaImage, P(256, 256, 94)},
        {"vol_frog/frog.mhd", plainMetaImage, P(500, 470, 136)},
        {"vol_HeadMR/HeadMRVolume.mhd", plainMetaImage, P(48, 62, 42)},
        {"vol_headsq_quarter/quarter.nhdr", plainNrrd, P(64, 64, 93), 0, 3926},
        {"vol_ironprot/ironProt.vtk", vtkVolume, P(68)},
        {"vol_neghip/neghip.slc", vtkVolume, P(66)},
        {"vol_heart_mayavi/heart.vti", vtkVolume, P(32, 32, 12)},
        {"vol_heart_mayavi/heart.vtk", vtkVolume, P(32, 32, 12)},
        {"vol_vase/vase.vti", vtkVolume, P(115, 101, 75)},
        {"vol_vase/vase_1comp.vti", vtkVolume, P(115, 101, 75)},
        {"vol_vase/vase_4comp.vti", vtkVolume, P(115, 101, 75)},
        {"vtk_encodings/volume_complex.vti", vtkVolume, P(3, 4, 6)},
        {"vtk_encodings/volume_complex.vtk", vtkVolume, P(3, 4, 6)},
        {"vtk_encodings/rectilinear_grid.vtk", vtkVolume, P(2, 3, 1)},
        {"vtk_encodings/rectilinear_grid_binary.vtk", vtkVolume, P(2, 3, 1)},
        {"vtk_encodings/RectilinearGrid_ascii.vtr", vtkVolume, P(3, 1, 1)},
        {"vtk_encodings/RectilinearGridAppendedBase64.vtr", vtkVolume, P(3, 1, 1)},
        {"vtk_encodings/RectilinearGridCompressed.vtr", vtkVolume, P(3, 1, 1)},
        {"vtk_encodings/RectilinearGridInlineBinary.vtr", vtkVolume, P(3, 1, 1)},
        {"vtk_encodings/RectilinearGridRawBinary.vtr", vtkVolume, P(3, 1, 1)},
        {"vtk_encodings/RectilinearGrid/RectilinearGrid_0.vtr", vtkVolume, P(3, 1, 1)},
        {"odd_nrrd_pynrrd/BallBinary30x30x30.nii.gz", plainNifti, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30.nrrd", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30.nhdr", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30_gz.nrrd", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30_bz2.nrrd", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30_gz_lineskip.nrrd", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30_gz_byteskip_minus_one.nrrd", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30_byteskip_minus_one.nhdr", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/BallBinary30x30x30_byteskip_minus_one_nifti.nhdr", plainNrrd, P(30), 0, 257},
        {"odd_nrrd_pynrrd/test1d_ascii.nrrd", plainNrrd, P(27, 1, 1)},
        {"odd_nrrd_pynrrd/test2d_ascii.nrrd", plainNrrd, P(3, 9, 1)},
        {"odd_nrrd_pynrrd/test_customFields.nrrd", plainNrrd, P(27, 1, 1)},
        {"odd_nrrd_pynrrd/test_simple4d_raw.nrrd", plainNrrd, P(1)},
        {"vol_nibabel/anatomical.nii", plainNifti, P(33, 41, 25)},
        {"vol_nibabel/example4d.nii.gz", plainNifti, P(128, 96, 24)},
        {"vol_nibabel/example_nifti2.nii.gz", plainNifti, P(32, 20, 12)},
        {"vol_nibabel/functional.nii", plainNifti, P(17, 21, 3)},
        {"vol_nibabel/someones_anatomy.nii.gz", plainNifti, P(57, 67, 56)},
        {"vol_nibabel/someones_epi.nii.gz", plainNifti, P(53, 61, 33)},
        {"vol_nibabel/standard.nii.gz", plainNifti, P(4, 5, 7)},
        {"vol_nifti_types/27_int8.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_uint8.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_int16.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_uint16.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_int32.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_uint32.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_int64.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_uint64.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_float32.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/27_float64.nii", plainNifti, P(3), 0, 26},
        {"vol_nifti_types/3D.nii", plainNifti, P(3)},
        {"vol_nifti_types/complex32.nii", plainNifti, P(3, 3, 1)},
        {"vol_nifti_types/complex64.nii", plainNifti, P(3, 3, 1)},
        {"vol_nifti_types/f32.nii.gz", plainNifti, P(11)},
        {"vol_nifti_types/minimal.nii", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal.nii.gz", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal.hdr", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal.hdr.gz", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal.img", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal.img.gz", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal2.hdr", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal2.img.gz", plainNifti, P(64, 64, 10)},
        {"vol_nifti_types/minimal_extended_hdr.nii", plainNifti, P(8, 8, 1)},
        {"vol_nifti_types/rgb_4D.nii", plainNifti, P(3)},
        {"vol_nifti_types/rgba_4D.nii", plainNifti, P(3)},
        {"vol_nifti_types/zstat1.nii.gz", plainNifti, P(64, 64, 21)},
        {"chg_H2/H2_CHGCAR", plainVasp, P(20, 20, 36), 0.0238, 33.3, 0.05},
        {"chg_NaMgF3_perovskite/NaMgF3_AECCAR0", plainVasp, P(40, 56, 40)},
        {"chg_NaMgF3_perovskite/NaMgF3_AECCAR2", plainVasp, P(40, 56, 40)},
        {"chg_NaMgF3_perovskite/NaMgF3_LOCPOT", plainVasp, P(40, 56, 40)},
        {"chg_CdTe_vacancy/bulk_vasp_gam/LOCPOT.gz", plainVasp, P(80)},
        {"chg_CdTe_vacancy/v_Cd_-2_vasp_gam/LOCPOT.gz", plainVasp, P(80)},
        {"cube_m4_total_density/m4_TotalDensity.cube", plainCube, P(25, 22, 31)},
        {"amr_chombo3d/chombo3d_0.vti", vtkVolume, P(8)},
        {"amr_chombo3d/chombo3d_1.vti", vtkVolume, P(16)},
        {"amr_chombo3d/chombo3d_2.vti", vtkVolume, P(12, 16, 16)},
        {"amr_chombo3d/chombo3d_3.vti", vtkVolume, P(4, 8, 8)},
        {"amr_chombo3d/chombo3d_4.vti", vtkVolume, P(8)},
        {"amr_chombo3d/chombo3d_5.vti", vtkVolume, P(4, 8, 8)},
        {"amr_chombo3d/chombo3d_6.vti", vtkVolume, P(4, 8, 8)},
        {"amr_chombo3d/chombo3d_7.vti", vtkVolume, P(4, 8, 8)},
        {"amr_chombo3d/chombo3d_8.vti", vtkVolume, P(4, 8, 8)},
        {"amr_chombo3d/chombo3d_9.vti", vtkVolume, P(4)},
        {"amr_chombo3d/chombo3d_10.vti", vtkVolume, P(4)},
        {"amr_chombo3d/chombo3d_11.vti", vtkVolume, P(4)},
        {"amr_chombo3d/chombo3d_12.vti", vtkVolume, P(4)},
        {"amr_chombo3d/chombo3d_13.vti", vtkVolume, P(4)},
        {"amr_chombo3d/chombo3d_14.vti", vtkVolume, P(4, 8, 8)},
        {"amr_chombo3d/chombo3d_15.vti", vtkVolume, P(8, 4, 4)},
    };
    return files;
}

const fs::path kData = VOXSHEET_DATA_DIR;

bool dataAreThere() { return fs::exists(kData / "MANIFEST.tsv"); }

class RealFiles : public ::testing::TestWithParam<RealFile> {
protected:
    void SetUp() override {
        if (!dataAreThere()) GTEST_SKIP() << "the data folder is absent";
    }
};

TEST_P(RealFiles, HasTheVoxelsThatAnotherReaderFinds) {
    const auto& file = GetParam();
    const auto expected = file.read(kData / file.path);
    const auto loaded = loadAny(kData / file.path);
    const auto& meta = loaded.meta();
    EXPECT_EQ(meta.grid.dims, file.dims);
    EXPECT_EQ(meta.grid.dims, expected.dims);
    EXPECT_EQ(meta.sourceType, expected.type) << scalarName(meta.sourceType);
    EXPECT_EQ(meta.stepCount(), expected.steps);
    const auto spacing = spacingWorld(meta.grid);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (expected.spacing[axis] == 0.0) continue;
        EXPECT_NEAR(spacing[axis], expected.spacing[axis],
                    1e-6 * expected.spacing[axis]); // matrices of floats
    }

    ASSERT_EQ(meta.fields.size() * meta.times.size(), expected.arrays.size());
    for (int field = 0; field < static_cast<int>(meta.fields.size()); ++field)
        for (int step = 0; step < expected.steps; ++step) {
            const auto& wanted = expected.arrays[static_cast<std::size_t>(field * expected.steps + step)];
            std::size_t different = 0;
            visitScalar(meta.fields[static_cast<std::size_t>(field)].storedType, [&]<typename T>() {
                const auto values = loaded.values<T>(field, step);
                ASSERT_EQ(values.size(), wanted.size());
                for (std::size_t i = 0; i < values.size(); ++i)
                    if (static_cast<double>(values[i]) != wanted[i]) ++different;
            });
            EXPECT_EQ(different, 0U) << "field " << field << ", step " << step;
        }
    if (file.low > file.high) return;
    const auto [low, high] = std::minmax_element(expected.arrays[0].begin(), expected.arrays[0].end());
    EXPECT_NEAR(*low, file.low, file.tolerance);
    EXPECT_NEAR(*high, file.high, file.tolerance);
}

std::string testName(const ::testing::TestParamInfo<RealFile>& file) {
    std::string name = file.param.path;
    for (auto& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Data, RealFiles, ::testing::ValuesIn(realFiles()), testName);

/// Files that hold no volume of their own.
bool isPartOrText(const fs::path& path) {
    const auto name = path.string();
    static const std::set<std::string> texts{"MANIFEST.tsv", "README.md", "LICENSE", "COPYING"};
    return name.starts_with("LICENSES/") || texts.contains(path.filename().string()) ||
           name.starts_with("vol_headsq_quarter/quarter.") || path.extension() == ".zraw";
}

TEST(RealFilesOfOtherKinds, EndInASentence) {
    if (!dataAreThere()) GTEST_SKIP() << "the data folder is absent";
    std::set<std::string> volumes;
    for (const auto& file : realFiles())
        volumes.insert(file.path);
    std::size_t refused = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kData)) {
        if (!entry.is_regular_file()) continue;
        const auto path = fs::relative(entry.path(), kData);
        if (volumes.erase(path.string()) != 0 || isPartOrText(path)) continue;
        if (path.extension() == ".vtm") continue; // patches: amr_test.cpp
        EXPECT_THROW((void)loadAny(entry.path()), Error) << path;
        ++refused;
    }
    EXPECT_TRUE(volumes.empty()) << *volumes.begin() << " is missing";
    EXPECT_GT(refused, 0U);
}

} // namespace
} // namespace voxsheet::import::testing
