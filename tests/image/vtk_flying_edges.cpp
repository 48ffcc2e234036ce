#include "image/vtk_flying_edges.h"

#include "image/vtk_image.h"

#include <vtkDataArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <cmath>

namespace voxsheet::image {

class VtkFlyingEdges::Implementation {
public:
    Implementation(const fields::SampledField& sampled, double isovalue) {
        const auto& field = sampled.meta.fields.at(0);
        filter_->SetInputData(vtkImageOf(sampled));
        filter_->SetValue(0, (isovalue - field.valueOffset) / field.valueScale);
        filter_->ComputeNormalsOn();
        filter_->Update();
        locator_->SetDataSet(filter_->GetOutput());
        locator_->BuildLocator();
    }

    [[nodiscard]] vtkPolyData* mesh() const { return filter_->GetOutput(); }
    [[nodiscard]] vtkStaticCellLocator* locator() const { return locator_; }

private:
    vtkNew<vtkFlyingEdges3D> filter_;
    vtkNew<vtkStaticCellLocator> locator_;
};

VtkFlyingEdges::VtkFlyingEdges(const fields::SampledField& sampled, double isovalue)
    : implementation_(std::make_unique<Implementation>(sampled, isovalue)) {
    auto* mesh = implementation_->mesh();
    auto* normals = mesh->GetPointData()->GetNormals();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i) {
        Vertex vertex;
        mesh->GetPoint(i, &vertex.position.x);
        normals->GetTuple(i, &vertex.normal.x);
        vertices_.push_back(vertex);
    }
}

VtkFlyingEdges::~VtkFlyingEdges() = default;

std::optional<glm::dvec3> VtkFlyingEdges::firstMeeting(const glm::dvec3& a, const glm::dvec3& b) const {
    double along = 0.0;
    glm::dvec3 point(0.0);
    glm::dvec3 parametric(0.0);
    int part = 0;
    const int met =
        implementation_->locator()->IntersectWithLine(&a.x, &b.x, 0.0, along, &point.x, &parametric.x, part);
    return met != 0 ? std::optional(point) : std::nullopt;
}

} // namespace voxsheet::image
