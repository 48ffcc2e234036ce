#include "image/vtk_peer.h"

#include "base/errors.h"
#include "gpu/context.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <chrono>
#include <cmath>
#include <cstring>

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

int vtkTypeOf(ScalarType type) {
    switch (type) {
    case ScalarType::U8:
        return VTK_UNSIGNED_CHAR;
    case ScalarType::U16:
        return VTK_UNSIGNED_SHORT;
    case ScalarType::F32:
        return VTK_FLOAT;
    default:
        throw Unsupported("comparison with VTK",
                          std::string("it does not cover samples of type ") + scalarName(type));
    }
}

vtkSmartPointer<vtkImageData> imageOf(const fields::SampledField& sampled) {
    const auto& grid = sampled.meta.grid;
    const auto& m = grid.worldFromIndex;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (row != column && m[column][row] != 0.0)
                throw Unsupported("comparison with VTK", "the grid is rotated or sheared");
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(grid.dims.x, grid.dims.y, grid.dims.z);
    image->SetSpacing(m[0][0], m[1][1], m[2][2]);
    image->SetOrigin(m[3][0], m[3][1], m[3][2]);
    image->AllocateScalars(vtkTypeOf(sampled.meta.fields[0].storedType), 1);
    const auto& bytes = sampled.arrays.at(0);
    std::memcpy(image->GetScalarPointer(), bytes.data(), bytes.size());
    return image;
}

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

} // namespace

class VtkPeer::Implementation {
public:
    Implementation(const fields::SampledField& sampled, VtkMapper kind)
        : grid_(sampled.meta.grid), field_(sampled.meta.fields.at(0)) {
        if (kind == VtkMapper::Gpu) {
            gpu_ = vtkSmartPointer<vtkOpenGLGPUVolumeRayCastMapper>::New();
            gpu_->SetUseJittering(0);
            gpu_->SetInputData(imageOf(sampled));
            volume_->SetMapper(gpu_);
        } else {
            cpu_ = vtkSmartPointer<vtkFixedPointVolumeRayCastMapper>::New();
            cpu_->SetInputData(imageOf(sampled));
            volume_->SetMapper(cpu_);
        }
        volume_->GetProperty()->SetInterpolationTypeToLinear();
        volume_->GetProperty()->ShadeOff();
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

    double lastMs_ = 0.0;

private:
    /// What is the same from frame to frame in a rotation; not timed.
    void prepare(const TileSpec& tile) {
        if (table_ != tile.transfer) {
            setTransfer(volume_->GetProperty(), *tile.transfer, field_);
            table_ = tile.transfer;
        }
        volume_->GetProperty()->SetScalarOpacityUnitDistance(tile.unitLengthWorld);
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

double VtkPeer::lastMs() const { return implementation_->lastMs_; }

} // namespace voxsheet::image
