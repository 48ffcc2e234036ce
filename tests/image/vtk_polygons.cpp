#include "image/vtk_polygons.h"

#include "image/vtk_image.h"
#include "image/vtk_window.h"

#include <vtkActor.h>
#include <vtkFlyingEdges3D.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace voxsheet::image {

class VtkPolygons::Implementation {
public:
    explicit Implementation(const fields::SampledField& sampled)
        : grid_(sampled.meta.grid), field_(sampled.meta.fields.at(0)) {
        filter_->SetInputData(vtkImageOf(sampled));
        filter_->ComputeNormalsOn();
        filter_->ComputeScalarsOff();
        mapper_->SetInputConnection(filter_->GetOutputPort());
        actor_->SetMapper(mapper_);
        window_.renderer().AddActor(actor_);
    }

    fields::Picture draw(const TileSpec& tile) {
        window_.makeCurrent();
        const auto& surface = tile.isosurface.surfaces.at(0);
        auto* property = actor_->GetProperty();
        property->SetColor(double(surface.colour.x), double(surface.colour.y), double(surface.colour.z));
        property->SetLighting(tile.shading.enabled);
        property->SetInterpolationToPhong();
        property->SetAmbient(tile.shading.ambient);
        property->SetDiffuse(tile.shading.diffuse);
        property->SetSpecular(tile.shading.specular);
        property->SetSpecularPower(tile.shading.shininess);
        return window_.draw(tile, grid_, [&] {
            filter_->SetValue(0, (surface.value - field_.valueOffset) / field_.valueScale);
            filter_->Update();
        });
    }

    [[nodiscard]] double lastMs() const { return window_.lastMs(); }
    [[nodiscard]] long triangles() const { return filter_->GetOutput()->GetNumberOfPolys(); }

private:
    VtkWindow window_;
    Grid grid_;
    FieldMeta field_;
    vtkNew<vtkFlyingEdges3D> filter_;
    vtkNew<vtkPolyDataMapper> mapper_;
    vtkNew<vtkActor> actor_;
};

VtkPolygons::VtkPolygons(const fields::SampledField& sampled)
    : implementation_(std::make_unique<Implementation>(sampled)) {}

VtkPolygons::~VtkPolygons() = default;

fields::Picture VtkPolygons::draw(const TileSpec& tile) { return implementation_->draw(tile); }

double VtkPolygons::lastMs() const { return implementation_->lastMs(); }

long VtkPolygons::triangles() const { return implementation_->triangles(); }

} // namespace voxsheet::image
