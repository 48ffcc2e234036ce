// AMR data by VTK's own writer, and which cell VTK finds at each place.
#include "../vtk_fixture.h"

#include <vtkAMRBox.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOverlappingAMR.h>
#include <vtkShortArray.h>
#include <vtkUniformGrid.h>
#include <vtkXMLUniformGridAMRWriter.h>

namespace voxsheet::import::testing {
namespace {

constexpr double kOrigin[3] = {-1.0, 2.0, 5.0};

class AmrByVtk : public FormatsTest {
protected:
    /// Three levels, refined by 2 in x and y and z: 6 x 4 x 4 cells of (1, 0.5, 2), two patches in it, and
    /// one in the second of these.
    void build() {
        const int blocks[3] = {1, 2, 1};
        amr_->Initialize(3, blocks);
        amr_->SetOrigin(kOrigin);
        amr_->SetGridDescription(VTK_XYZ_GRID);
        for (unsigned level = 0; level < 3; ++level) {
            const double shrink = 1.0 / (1U << level);
            const double spacing[3] = {1.0 * shrink, 0.5 * shrink, 2.0 * shrink};
            amr_->SetSpacing(level, spacing);
        }
        add(0, 0, {0, 0, 0}, {5, 3, 3});
        add(1, 0, {2, 2, 2}, {3, 5, 5});
        add(1, 1, {6, 0, 4}, {11, 3, 7});
        add(2, 0, {16, 2, 10}, {19, 5, 13});
    }

    void add(unsigned level, unsigned id, const std::array<int, 3>& low, const std::array<int, 3>& high) {
        const vtkAMRBox box(low.data(), high.data());
        amr_->SetAMRBox(level, id, box);
        double spacing[3];
        amr_->GetSpacing(level, spacing);
        vtkNew<vtkUniformGrid> grid;
        double start[3];
        int points[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start[axis] = kOrigin[axis] + low[axis] * spacing[axis];
            points[axis] = high[axis] - low[axis] + 2;
        }
        grid->SetOrigin(start);
        grid->SetSpacing(spacing);
        grid->SetDimensions(points);
        vtkNew<vtkFloatArray> density;
        density->SetName("density");
        vtkNew<vtkShortArray> moved;
        moved->SetName("moved");
        moved->SetNumberOfComponents(3);
        for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
            const auto value =
                static_cast<float>(1000U * level + 100U * id) + static_cast<float>(cell) * 0.25F;
            density->InsertNextValue(value);
            moved->InsertNextTuple3(static_cast<double>(cell), -static_cast<double>(cell), level);
        }
        grid->GetCellData()->AddArray(density);
        grid->GetCellData()->AddArray(moved);
        amr_->SetDataSet(level, id, grid);
    }

    /// Of the finest patch that holds the place.
    [[nodiscard]] double at(const glm::dvec3& world, const char* array, int component) const {
        for (unsigned level = amr_->GetNumberOfLevels(); level-- > 0;)
            for (unsigned id = 0; id < amr_->GetNumberOfDataSets(level); ++id) {
                auto* const grid = amr_->GetDataSet(level, id);
                double point[3] = {world.x, world.y, world.z};
                double within[3];
                double weights[8];
                int sub = 0;
                const auto cell = grid->FindCell(point, nullptr, 0, 0.0, sub, within, weights);
                if (cell >= 0) return grid->GetCellData()->GetArray(array)->GetComponent(cell, component);
            }
        return std::nan("");
    }

    vtkNew<vtkOverlappingAMR> amr_;
};

TEST_F(AmrByVtk, EveryCellHasTheValueThatVtkFindsThere) {
    build();
    const auto file = folder_ / "a.vth";
    vtkNew<vtkXMLUniformGridAMRWriter> writer;
    writer->SetInputData(amr_);
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        writer->SetFileName(file.c_str());
        writer->SetDataMode(mode);
        ASSERT_EQ(writer->Write(), 1);
        const auto loaded = loadAny(file);
        const auto& grid = loaded.meta().grid;
        ASSERT_EQ(grid.dims, glm::ivec3(24, 16, 16));
        EXPECT_EQ(spacingWorld(grid), glm::dvec3(0.25, 0.125, 0.5));
        ASSERT_EQ(loaded.meta().fields.size(), 4U);
        EXPECT_EQ(loaded.meta().fields[0].name, "density");
        expectMentions(loaded.meta().notes.at(0), "its 4 patches in 3 levels");
        const auto density = loaded.values<float>(0);
        const auto moved = loaded.values<short>(2);
        std::size_t i = 0;
        for (int z = 0; z < grid.dims.z; ++z)
            for (int y = 0; y < grid.dims.y; ++y)
                for (int x = 0; x < grid.dims.x; ++x, ++i) {
                    const glm::dvec3 world(grid.worldFromIndex * glm::dvec4(x, y, z, 1.0));
                    ASSERT_EQ(density[i], at(world, "density", 0)) << x << ' ' << y << ' ' << z;
                    ASSERT_EQ(moved[i], at(world, "moved", 1)) << x << ' ' << y << ' ' << z;
                }
    }
}

} // namespace
} // namespace voxsheet::import::testing
