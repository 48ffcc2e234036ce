// EGL with no display: the devices of this machine, and contexts on them. Private to this room.
#pragma once

#include <epoxy/egl.h>

#include <string>
#include <vector>

namespace voxsheet::gpu {

/// A way to reach a GPU or a software renderer.
struct EglCandidate {
    std::string name; ///< "device 0 (/dev/dri/card0)", "surfaceless Mesa"
    EGLenum platform = 0;
    void* native = nullptr;
};

/// The devices of EGL_EXT_device_enumeration in EGL's order, then the surfaceless platform of Mesa where it
/// is there. Throws GpuError, naming the packages to install, when libEGL or libOpenGL is missing.
[[nodiscard]] std::vector<EglCandidate> eglCandidates();

/// A display shared by all contexts of the process on one device: EGL has one per device, and terminating it
/// would take it from the others.
class SharedDisplay {
public:
    explicit SharedDisplay(const EglCandidate& candidate);
    SharedDisplay(const SharedDisplay&) = delete;
    SharedDisplay& operator=(const SharedDisplay&) = delete;
    ~SharedDisplay();
    [[nodiscard]] EGLDisplay handle() const { return display_; }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
};

/// An OpenGL 4.5 core context without a surface.
class EglContext {
public:
    /// Makes it current on the calling thread. Throws GpuError naming the candidate and EGL's error.
    explicit EglContext(const EglCandidate& candidate);
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

    void makeCurrent() const;
    void releaseCurrent() const;
    [[nodiscard]] bool robust() const { return robust_; } ///< tells of resets
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    void create();

    std::string name_;
    SharedDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
    bool robust_ = false;
};

/// GL_RENDERER of a software renderer.
[[nodiscard]] bool isSoftwareRenderer(const std::string& renderer);

} // namespace voxsheet::gpu
