#include "image/vtk_volume.h"

#include "base/errors.h"
#include "image/vtk_image.h"

#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

namespace voxsheet::image {
namespace {

/// Control points at every entry, in stored numbers: VTK knows no slope and intercept.
void setTransfer(vtkVolumeProperty* property, const TransferTable& table, const FieldMeta& field) {
    if (table.scale != ValueScale::Linear)
        throw Unsupported("comparison with VTK", "the table's scale is not linear");
    vtkNew<vtkColorTransferFunction> colour;
    vtkNew<vtkPiecewiseFunction> opacity;
    const double last = static_cast<double>(table.entries.size() - 1);
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const double value = table.low + (table.high - table.low) * static_cast<double>(i) / last;
        const double stored = (value - field.valueOffset) / field.valueScale;
        const auto& entry = table.entries[i];
        colour->AddRGBPoint(stored, double(entry.x), double(entry.y), double(entry.z));
        opacity->AddPoint(stored, double(entry.w));
    }
    property->SetColor(colour);
    property->SetScalarOpacity(opacity);
}

template <typename Mapper>
void fixDistances(Mapper* mapper, double sampleDistanceWorld) {
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetLockSampleDistanceToInputSpacing(0);
    mapper->SetImageSampleDistance(1.0F);
    mapper->SetSampleDistance(static_cast<float>(sampleDistanceWorld));
}

/// VTK's mappers keep what lies on the side that a plane's normal points to, as we do.
void setPlanes(vtkVolumeMapper* mapper, const std::vector<ClipPlane>& planes) {
    mapper->RemoveAllClippingPlanes();
    for (const auto& plane : planes) {
        vtkNew<vtkPlane> theirs;
        const auto on = plane.offset * plane.normal;
        theirs->SetOrigin(on.x, on.y, on.z);
        theirs->SetNormal(plane.normal.x, plane.normal.y, plane.normal.z);
        mapper->AddClippingPlane(theirs);
    }
}

void setShading(vtkVolumeProperty* property, const ShadingSpec& shading) {
    property->SetShade(shading.enabled ? 1 : 0);
    if (!shading.enabled) return;
    if (!shading.lightsView.empty() || shading.headLight != 1.0)
        throw Unsupported("comparison with VTK", "it covers a full head light alone");
    property->SetAmbient(shading.ambient);
    property->SetDiffuse(shading.diffuse);
    property->SetSpecular(shading.specular);
    property->SetSpecularPower(shading.shininess);
}

} // namespace

VtkVolume::VtkVolume(const fields::SampledField& sampled, VtkMapper kind)
    : grid_(sampled.meta.grid), field_(sampled.meta.fields.at(0)) {
    if (kind == VtkMapper::Gpu) {
        gpu_ = vtkSmartPointer<vtkOpenGLGPUVolumeRayCastMapper>::New();
        gpu_->SetUseJittering(0);
        gpu_->SetInputData(vtkImageOf(sampled));
        volume_->SetMapper(gpu_);
    } else {
        cpu_ = vtkSmartPointer<vtkFixedPointVolumeRayCastMapper>::New();
        cpu_->SetInputData(vtkImageOf(sampled));
        volume_->SetMapper(cpu_);
    }
    volume_->GetProperty()->SetInterpolationTypeToLinear();
}

vtkVolumeMapper* VtkVolume::mapper() const {
    return gpu_ != nullptr ? static_cast<vtkVolumeMapper*>(gpu_) : static_cast<vtkVolumeMapper*>(cpu_);
}

void VtkVolume::crop(const glm::dvec3& low, const glm::dvec3& high) {
    mapper()->SetCropping(1);
    mapper()->SetCroppingRegionFlagsToSubVolume();
    mapper()->SetCroppingRegionPlanes(low.x, high.x, low.y, high.y, low.z, high.z);
}

void VtkVolume::mask(const std::vector<unsigned char>& kept) {
    if (gpu_ == nullptr) throw Unsupported("comparison with VTK", "its CPU mapper has no masks");
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->CopyStructure(vtkImageData::SafeDownCast(gpu_->GetInput()));
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    std::copy(kept.begin(), kept.end(), static_cast<unsigned char*>(image->GetScalarPointer()));
    gpu_->SetMaskInput(image);
    gpu_->SetMaskTypeToBinary();
}

void VtkVolume::prepare(const TileSpec& tile) {
    if (table_ != tile.transfer) {
        setTransfer(volume_->GetProperty(), *tile.transfer, field_);
        table_ = tile.transfer;
    }
    volume_->GetProperty()->SetScalarOpacityUnitDistance(tile.unitLengthWorld);
    setShading(volume_->GetProperty(), tile.shading);
    setPlanes(mapper(), tile.clip.planes);
    setBlend(tile);
    // VTK's distance is in the world and the same in all directions: along the central ray it is ours.
    const auto view = glm::inverse(tile.camera.viewFromWorld);
    const auto ahead = glm::dmat3(glm::inverse(grid_.worldFromIndex)) * -glm::dvec3(view[2]);
    const double distance = tile.sampleDistanceVoxels / glm::length(ahead);
    if (gpu_ != nullptr) fixDistances(gpu_.Get(), distance);
    if (cpu_ != nullptr) fixDistances(cpu_.Get(), distance);
}

/// Isosurfaces take their colour and opacity from the table.
void VtkVolume::setBlend(const TileSpec& tile) {
    if (tile.technique == Technique::Mip) return mapper()->SetBlendModeToMaximumIntensity();
    if (tile.technique != Technique::Isosurface) return mapper()->SetBlendModeToComposite();
    mapper()->SetBlendModeToIsoSurface();
    auto* values = volume_->GetProperty()->GetIsoSurfaceValues();
    const auto& surfaces = tile.isosurface.surfaces;
    values->SetNumberOfContours(static_cast<int>(surfaces.size()));
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        values->SetValue(static_cast<int>(i), (surfaces[i].value - field_.valueOffset) / field_.valueScale);
}

} // namespace voxsheet::image
