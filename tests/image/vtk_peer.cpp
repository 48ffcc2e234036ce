#include "image/vtk_peer.h"

#include "base/errors.h"
#include "gpu/context.h"
#include "image/vtk_image.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <chrono>
#include <cmath>

namespace voxsheet::image {
namespace {

/// GLEW looks for a GLX display, finds none and reports a failure, but has loaded the functions by then. VTK
/// would therefore initialise again for every frame, which would be unfair to it.
class PeerWindow : public vtkGenericOpenGLRenderWindow {
public:
    static PeerWindow* New();
    vtkTypeMacro(PeerWindow, vtkGenericOpenGLRenderWindow);

    void OpenGLInitContext() override {
        if (this->Initialized) return;
        const int warnings = vtkObject::GetGlobalWarningDisplay();
        vtkObject::SetGlobalWarningDisplay(0);
        this->Superclass::OpenGLInitContext();
        vtkObject::SetGlobalWarningDisplay(warnings);
        this->Initialized = true;
        this->GlewInitValid = true;
    }
};
vtkStandardNewMacro(PeerWindow);

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

class VtkPeer::Implementation {
public:
    Implementation(const fields::SampledField& sampled, VtkMapper kind)
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
        renderer_->SetBackground(0.0, 0.0, 0.0);
        renderer_->AddVolume(volume_);
        window_->SetOwnContext(0);
        window_->SetMultiSamples(0);
        window_->SetFrameBlitModeToNoBlit(); // there is no window to show the frame in
        window_->SetIsCurrent(true);
        window_->SetReadyForRendering(true);
        window_->OpenGLInit();
        window_->AddRenderer(renderer_);
    }

    ~Implementation() {
        context_.makeCurrent();
        window_->Finalize();
    }

    fields::Picture draw(const TileSpec& tile) {
        context_.makeCurrent();
        prepare(tile);
        const auto start = std::chrono::steady_clock::now();
        setCamera(tile.camera);
        window_->Render();
        window_->GetPixelData(0, 0, tile.sizePixels.x - 1, tile.sizePixels.y - 1, 0, pixels_, 0);
        lastMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        fields::Picture picture(tile.sizePixels);
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const auto channel = [&](std::size_t c) {
                return double(pixels_->GetValue(static_cast<vtkIdType>(3 * i + c))) / 255.0;
            };
            picture.pixels[i] = {channel(0), channel(1), channel(2), 1.0};
        }
        return picture;
    }

    void crop(const glm::dvec3& low, const glm::dvec3& high) {
        mapper()->SetCropping(1);
        mapper()->SetCroppingRegionFlagsToSubVolume();
        mapper()->SetCroppingRegionPlanes(low.x, high.x, low.y, high.y, low.z, high.z);
    }

    double lastMs_ = 0.0;

private:
    [[nodiscard]] vtkVolumeMapper* mapper() const {
        return gpu_ != nullptr ? static_cast<vtkVolumeMapper*>(gpu_) : static_cast<vtkVolumeMapper*>(cpu_);
    }

    /// What is the same from frame to frame in a rotation; not timed.
    void prepare(const TileSpec& tile) {
        if (table_ != tile.transfer) {
            setTransfer(volume_->GetProperty(), *tile.transfer, field_);
            table_ = tile.transfer;
        }
        volume_->GetProperty()->SetScalarOpacityUnitDistance(tile.unitLengthWorld);
        setShading(volume_->GetProperty(), tile.shading);
        setPlanes(mapper(), tile.clip.planes);
        window_->SetSize(tile.sizePixels.x, tile.sizePixels.y);
        // VTK's distance is in the world and the same in all directions: along the central ray it is ours.
        const auto view = glm::inverse(tile.camera.viewFromWorld);
        const auto ahead = glm::dmat3(glm::inverse(grid_.worldFromIndex)) * -glm::dvec3(view[2]);
        const double distance = tile.sampleDistanceVoxels / glm::length(ahead);
        if (gpu_ != nullptr) fixDistances(gpu_.Get(), distance);
        if (cpu_ != nullptr) fixDistances(cpu_.Get(), distance);
    }

    void setCamera(const CameraSpec& spec) {
        const auto worldFromView = glm::inverse(spec.viewFromWorld);
        const glm::dvec3 eye(worldFromView[3]);
        const auto focus = eye - glm::dvec3(worldFromView[2]) * glm::distance(eye, centreWorld(grid_));
        auto* camera = renderer_->GetActiveCamera();
        camera->SetPosition(eye.x, eye.y, eye.z);
        camera->SetFocalPoint(focus.x, focus.y, focus.z);
        camera->SetViewUp(worldFromView[1].x, worldFromView[1].y, worldFromView[1].z);
        camera->SetViewAngle(spec.fovYDegrees);
        camera->SetParallelProjection(spec.projection == Projection::Orthographic ? 1 : 0);
        camera->SetParallelScale(0.5 * spec.heightWorld);
        renderer_->ResetCameraClippingRange();
    }

    gpu::Context context_;
    Grid grid_;
    FieldMeta field_;
    std::shared_ptr<const TransferTable> table_;
    vtkNew<PeerWindow> window_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkVolume> volume_;
    vtkSmartPointer<vtkOpenGLGPUVolumeRayCastMapper> gpu_;
    vtkSmartPointer<vtkFixedPointVolumeRayCastMapper> cpu_;
    vtkNew<vtkUnsignedCharArray> pixels_;
};

VtkPeer::VtkPeer(const fields::SampledField& sampled, VtkMapper mapper)
    : implementation_(std::make_unique<Implementation>(sampled, mapper)) {}

VtkPeer::~VtkPeer() = default;

fields::Picture VtkPeer::draw(const TileSpec& tile) { return implementation_->draw(tile); }

void VtkPeer::crop(const glm::dvec3& lowWorld, const glm::dvec3& highWorld) {
    implementation_->crop(lowWorld, highWorld);
}

double VtkPeer::lastMs() const { return implementation_->lastMs_; }

} // namespace voxsheet::image
