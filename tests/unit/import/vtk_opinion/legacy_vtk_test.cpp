// Legacy files by VTK's own writers, of both versions that it writes.
#include "../vtk_fixture.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridWriter.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkUnsignedShortArray.h>

namespace voxsheet::import::testing {
namespace {

constexpr int kPoints = 5 * 4 * 3;

class LegacyByVtk : public FormatsTest {
protected:
    /// Scalars, vectors, a tensor-like array of four and cell data: with names, and with the ranges that VTK
    /// adds to arrays as metadata.
    static void addArrays(vtkDataSet& set) {
        vtkNew<vtkUnsignedShortArray> scalars;
        scalars->SetName("count of it"); // VTK writes blanks as %20
        vtkNew<vtkFloatArray> vectors;
        vectors->SetName("moved");
        vectors->SetNumberOfComponents(3);
        vtkNew<vtkDoubleArray> four;
        four->SetName("four");
        four->SetNumberOfComponents(4);
        for (int i = 0; i < kPoints; ++i) {
            scalars->InsertNextValue(static_cast<unsigned short>(1000 * i));
            vectors->InsertNextTuple3(i, -0.5 * i, 2.0);
            four->InsertNextTuple4(i, 2.0 * i, 0.25, -i);
        }
        vectors->SetComponentName(0, "east");
        (void)vectors->GetRange(-1); // leaves information behind
        (void)four->GetRange(-1);
        set.GetPointData()->SetScalars(scalars);
        set.GetPointData()->SetVectors(vectors);
        set.GetPointData()->AddArray(four);
        vtkNew<vtkDoubleArray> time; // belongs to the whole, as simulations write it
        time->SetName("TimeValue");
        time->InsertNextValue(0.25);
        set.GetFieldData()->AddArray(time);
        vtkNew<vtkFloatArray> cells;
        cells->SetName("of cells");
        for (int i = 0; i < 4 * 3 * 2; ++i)
            cells->InsertNextValue(static_cast<float>(i));
        set.GetCellData()->SetScalars(cells);
    }

    template <typename Writer>
    void expectArrays(Writer& writer, const glm::dvec3& spacing) {
        for (const bool binary : {false, true})
            for (const int version : {42, 51}) {
                const auto file = folder_ / "a.vtk";
                writer.SetFileName(file.c_str());
                if (binary)
                    writer.SetFileTypeToBinary();
                else
                    writer.SetFileTypeToASCII();
                writer.SetFileVersion(version);
                ASSERT_EQ(writer.Write(), 1);
                SCOPED_TRACE((binary ? "binary, " : "text, ") + std::to_string(version));
                const auto loaded = loadAny(file);
                EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 4, 3));
                EXPECT_LT(glm::distance(spacingWorld(loaded.meta().grid), spacing), 1e-6);
                ASSERT_EQ(loaded.meta().fields.size(), 8U);
                EXPECT_EQ(loaded.meta().fields[0].name, "count of it");
                EXPECT_EQ(loaded.meta().fields[2].name, "moved y");
                EXPECT_EQ(loaded.meta().fields[7].name, "four 4");
                for (std::size_t i = 0; i < kPoints; ++i) {
                    ASSERT_EQ(loaded.values<unsigned short>(0)[i], 1000 * i);
                    ASSERT_EQ(loaded.values<float>(2)[i], -0.5F * static_cast<float>(i));
                    ASSERT_EQ(loaded.values<double>(7)[i], -static_cast<double>(i));
                }
            }
    }
};

TEST_F(LegacyByVtk, StructuredPointsWithMetadata) {
    vtkNew<vtkStructuredPoints> image;
    image->SetDimensions(5, 4, 3);
    image->SetSpacing(0.5, 2.0, 3.0);
    image->SetOrigin(-1.0, 4.0, 7.0);
    addArrays(*image);
    vtkNew<vtkStructuredPointsWriter> writer;
    writer->SetInputData(image);
    expectArrays(*writer, {0.5, 2.0, 3.0});
}

TEST_F(LegacyByVtk, RectilinearGridsWithMetadata) {
    vtkNew<vtkRectilinearGrid> grid;
    grid->SetDimensions(5, 4, 3);
    const auto along = [](int count, double step) {
        auto coordinates = vtkSmartPointer<vtkFloatArray>::New();
        for (int i = 0; i < count; ++i)
            coordinates->InsertNextValue(static_cast<float>(step * i));
        return coordinates;
    };
    grid->SetXCoordinates(along(5, 0.5));
    grid->SetYCoordinates(along(4, 2.0));
    grid->SetZCoordinates(along(3, 3.0));
    addArrays(*grid);
    vtkNew<vtkRectilinearGridWriter> writer;
    writer->SetInputData(grid);
    expectArrays(*writer, {0.5, 2.0, 3.0});
}

} // namespace
} // namespace voxsheet::import::testing
