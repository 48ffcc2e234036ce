// vtkSLCReader, as a second opinion on values and orientation.
#include "../formats_fixture.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSLCReader.h>

namespace voxsheet::import::testing {
namespace {

TEST(SlcInVtk, HasTheSameVoxelsInTheSamePlaces) {
    const auto path = fs::path(VOXSHEET_DATA_DIR) / "vol_neghip/neghip.slc";
    if (!fs::exists(path)) GTEST_SKIP() << "the data folder is absent";
    const auto loaded = load(path);
    vtkNew<vtkSLCReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    auto* const image = reader->GetOutput();
    const auto dims = loaded.meta().grid.dims;
    ASSERT_EQ(glm::ivec3(image->GetDimensions()[0], image->GetDimensions()[1], image->GetDimensions()[2]),
              dims);
    ASSERT_EQ(image->GetScalarType(), VTK_UNSIGNED_CHAR);
    const auto spacing = spacingWorld(loaded.meta().grid);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(image->GetSpacing()[axis], spacing[axis]);
    const auto values = loaded.values<unsigned char>();
    std::size_t index = 0;
    std::size_t different = 0;
    for (int k = 0; k < dims.z; ++k)
        for (int j = 0; j < dims.y; ++j)
            for (int i = 0; i < dims.x; ++i)
                if (values[index++] != *static_cast<unsigned char*>(image->GetScalarPointer(i, j, k)))
                    ++different;
    EXPECT_EQ(different, 0U);
}

} // namespace
} // namespace voxsheet::import::testing
