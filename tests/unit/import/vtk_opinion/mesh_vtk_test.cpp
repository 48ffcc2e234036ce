// VTK's distances to a surface, as a second opinion.
#include "../mesh_bytes.h"
#include "../vtk_fixture.h"

#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>

namespace voxsheet::import::testing {
namespace {

class MeshInVtk : public FormatsTest {};

vtkNew<vtkPolyData> surfaceOf(const TestMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& p : mesh.points)
        points->InsertNextPoint(p.x, p.y, p.z);
    vtkNew<vtkCellArray> triangles;
    for (const auto& t : mesh.triangles) {
        triangles->InsertNextCell(3);
        for (const auto corner : t)
            triangles->InsertCellPoint(corner);
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(triangles);
    return surface;
}

TEST_F(MeshInVtk, GivesTheSameDistances) {
    for (const auto& mesh : {torusMesh(5.0, 2.0, 24, 12), cubeMesh(2.0), sphereMesh(3.0, 2)}) {
        ImportOptions options;
        options.resolution = 24;
        const auto loaded = loadAny(write("surface.obj", obj(mesh)), options);
        vtkNew<vtkImplicitPolyDataDistance> distance;
        distance->SetInput(surfaceOf(mesh));
        const auto values = loaded.values<float>();
        const auto& grid = loaded.meta().grid;
        double worst = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto x = static_cast<int>(i) % grid.dims.x;
            const auto y = static_cast<int>(i) / grid.dims.x % grid.dims.y;
            const auto z = static_cast<int>(i) / (grid.dims.x * grid.dims.y);
            const auto p = grid.worldFromIndex * glm::dvec4(x, y, z, 1.0);
            worst = std::max(worst, std::abs(double(values[i]) - distance->EvaluateFunction(p.x, p.y, p.z)));
        }
        EXPECT_LT(worst, 1e-5);
    }
}

} // namespace
} // namespace voxsheet::import::testing
