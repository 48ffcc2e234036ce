// A window of VTK's without a screen: what it draws into an EGL context of ours, and how long that takes.
#pragma once

#include "fields/picture.h"
#include "gpu/context.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <functional>

namespace voxsheet::image {

/// GLEW looks for a GLX display, finds none and reports a failure, but has loaded the functions by then. VTK
/// would therefore initialise again for every frame, which would be unfair to it.
class PeerWindow : public vtkGenericOpenGLRenderWindow {
public:
    static PeerWindow* New();
    vtkTypeMacro(PeerWindow, vtkGenericOpenGLRenderWindow);

    void OpenGLInitContext() override;
};

/// One renderer on black, no multisampling.
class VtkWindow {
public:
    /// Throws GpuError without EGL.
    VtkWindow();
    ~VtkWindow();
    VtkWindow(const VtkWindow&) = delete;
    VtkWindow& operator=(const VtkWindow&) = delete;

    [[nodiscard]] vtkRenderer& renderer() { return *renderer_; }
    /// Before anything of VTK's touches OpenGL.
    void makeCurrent() { context_.makeCurrent(); }

    /// The picture in 8 bits, as VTK gives it to the host; alpha is 1 throughout. Timed from `change`, which
    /// is run first, to the pixels on the host.
    /// \param grid  whose centre the camera looks at
    [[nodiscard]] fields::Picture draw(const TileSpec& tile, const Grid& grid,
                                       const std::function<void()>& change = {});
    [[nodiscard]] double lastMs() const { return lastMs_; }

private:
    void setCamera(const CameraSpec& spec, const Grid& grid);

    gpu::Context context_;
    vtkNew<PeerWindow> window_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkUnsignedCharArray> pixels_;
    double lastMs_ = 0.0;
};

} // namespace voxsheet::image
