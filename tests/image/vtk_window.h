// A window of VTK's without a screen: what it draws into an EGL context of ours, and how long that takes.
#pragma once

#include "fields/picture.h"
#include "gpu/context.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <vector>

namespace voxsheet::image {

/// GLEW looks for a GLX display, finds none and reports a failure, but has loaded the functions by then. VTK
/// would therefore initialise again for every frame, which would be unfair to it.
class PeerWindow : public vtkGenericOpenGLRenderWindow {
public:
    static PeerWindow* New();
    vtkTypeMacro(PeerWindow, vtkGenericOpenGLRenderWindow);

    void OpenGLInitContext() override;
};

/// Renderers on black side by side, no multisampling.
class VtkWindow {
public:
    /// \param cells  columns and rows of renderers. Throws GpuError without EGL.
    explicit VtkWindow(glm::ivec2 cells = glm::ivec2(1));
    ~VtkWindow();
    VtkWindow(const VtkWindow&) = delete;
    VtkWindow& operator=(const VtkWindow&) = delete;

    /// From left to right, row by row from the top.
    [[nodiscard]] vtkRenderer& renderer(std::size_t cell = 0) { return *renderers_.at(cell); }
    /// Before anything of VTK's touches OpenGL.
    void makeCurrent() { context_.makeCurrent(); }

    /// The picture in 8 bits, as VTK gives it to the host; alpha is 1 throughout. Timed from `change`, which
    /// is run first, to the pixels on the host.
    /// \param grid  whose centre the camera looks at
    [[nodiscard]] fields::Picture draw(const TileSpec& tile, const Grid& grid,
                                       const std::function<void()>& change = {});
    /// The same for all cells at once: their pictures have the first tile's size.
    struct Cell {
        TileSpec tile;
        Grid grid;
    };
    [[nodiscard]] fields::Picture draw(const std::vector<Cell>& cells,
                                       const std::function<void()>& change = {});
    [[nodiscard]] double lastMs() const { return lastMs_; }

private:
    static void setCamera(vtkRenderer& renderer, const CameraSpec& spec, const Grid& grid);

    glm::ivec2 cells_;

    gpu::Context context_;
    vtkNew<PeerWindow> window_;
    std::vector<vtkSmartPointer<vtkRenderer>> renderers_;
    vtkNew<vtkUnsignedCharArray> pixels_;
    double lastMs_ = 0.0;
};

} // namespace voxsheet::image
