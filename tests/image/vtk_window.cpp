#include "image/vtk_window.h"

#include <vtkCamera.h>
#include <vtkObjectFactory.h>

#include <chrono>

namespace voxsheet::image {

vtkStandardNewMacro(PeerWindow);

void PeerWindow::OpenGLInitContext() {
    if (this->Initialized) return;
    const int warnings = vtkObject::GetGlobalWarningDisplay();
    vtkObject::SetGlobalWarningDisplay(0);
    this->Superclass::OpenGLInitContext();
    vtkObject::SetGlobalWarningDisplay(warnings);
    this->Initialized = true;
    this->GlewInitValid = true;
}

VtkWindow::VtkWindow(glm::ivec2 cells) : cells_(cells) {
    window_->SetOwnContext(0);
    window_->SetMultiSamples(0);
    window_->SetFrameBlitModeToNoBlit(); // there is no window to show the frame in
    window_->SetIsCurrent(true);
    window_->SetReadyForRendering(true);
    window_->OpenGLInit();
    const glm::dvec2 size = 1.0 / glm::dvec2(cells);
    for (int row = 0; row < cells.y; ++row)
        for (int column = 0; column < cells.x; ++column) {
            auto renderer = vtkSmartPointer<vtkRenderer>::New();
            renderer->SetBackground(0.0, 0.0, 0.0);
            const auto low = size * glm::dvec2(column, cells.y - 1 - row);
            renderer->SetViewport(low.x, low.y, low.x + size.x, low.y + size.y);
            window_->AddRenderer(renderer);
            renderers_.push_back(renderer);
        }
}

VtkWindow::~VtkWindow() {
    context_.makeCurrent();
    window_->Finalize();
}

fields::Picture VtkWindow::draw(const TileSpec& tile, const Grid& grid, const std::function<void()>& change) {
    return draw({{tile, grid}}, change);
}

fields::Picture VtkWindow::draw(const std::vector<Cell>& cells, const std::function<void()>& change) {
    context_.makeCurrent();
    const auto size = cells_ * cells.at(0).tile.sizePixels;
    window_->SetSize(size.x, size.y);
    const auto start = std::chrono::steady_clock::now();
    if (change) change();
    for (std::size_t i = 0; i < cells.size(); ++i)
        setCamera(*renderers_.at(i), cells[i].tile.camera, cells[i].grid);
    window_->Render();
    window_->GetPixelData(0, 0, size.x - 1, size.y - 1, 0, pixels_, 0);
    lastMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    fields::Picture picture(size);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto channel = [&](std::size_t c) {
            return double(pixels_->GetValue(static_cast<vtkIdType>(3 * i + c))) / 255.0;
        };
        picture.pixels[i] = {channel(0), channel(1), channel(2), 1.0};
    }
    return picture;
}

void VtkWindow::setCamera(vtkRenderer& renderer, const CameraSpec& spec, const Grid& grid) {
    const auto worldFromView = glm::inverse(spec.viewFromWorld);
    const glm::dvec3 eye(worldFromView[3]);
    const auto focus = eye - glm::dvec3(worldFromView[2]) * glm::distance(eye, centreWorld(grid));
    auto* camera = renderer.GetActiveCamera();
    camera->SetPosition(eye.x, eye.y, eye.z);
    camera->SetFocalPoint(focus.x, focus.y, focus.z);
    camera->SetViewUp(worldFromView[1].x, worldFromView[1].y, worldFromView[1].z);
    camera->SetViewAngle(spec.fovYDegrees);
    camera->SetParallelProjection(spec.projection == Projection::Orthographic ? 1 : 0);
    camera->SetParallelScale(0.5 * spec.heightWorld);
    renderer.ResetCameraClippingRange();
}

} // namespace voxsheet::image
