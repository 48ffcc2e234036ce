#include "gpu/egl_context.h"

#include "base/errors.h"

#include <array>
#include <cstdlib>
#include <map>
#include <mutex>

namespace voxsheet::gpu {

namespace {

std::string eglErrorName(EGLint error) {
    switch (error) {
    case EGL_SUCCESS:
        return "no EGL error";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
        return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
        return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    case EGL_BAD_DEVICE_EXT:
        return "EGL_BAD_DEVICE_EXT";
    case EGL_CONTEXT_LOST:
        return "EGL_CONTEXT_LOST";
    default:
        return "EGL error " + std::to_string(error);
    }
}

/// How many SharedDisplays hold each EGLDisplay. Process-wide, as EGL's displays are.
struct DisplayUsers {
    std::mutex mutex;
    std::map<EGLDisplay, int> counts;
};

DisplayUsers& displayUsers() {
    static DisplayUsers users;
    return users;
}

/// Contexts from most to least wanted: robust access guards against out-of-range indices of a faulty shader,
/// reset notification tells when the GPU was reset.
struct Wish {
    bool robustAccess;
    bool resetNotification;
};
constexpr std::array kWishes{Wish{true, true}, Wish{false, true}, Wish{false, false}};

std::vector<EGLint> contextAttributes(const Wish& wish) {
    std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       4,
                                   EGL_CONTEXT_MINOR_VERSION,       5,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    const auto add = [&](EGLint key, EGLint value) { attributes.insert(attributes.end(), {key, value}); };
    if (wish.robustAccess) add(EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE);
    if (wish.resetNotification) {
        add(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET);
    }
    if (std::getenv("VOXSHEET_GL_DEBUG") != nullptr) add(EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE);
    attributes.push_back(EGL_NONE);
    return attributes;
}

EGLConfig chooseConfig(EGLDisplay display) {
    if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    eglChooseConfig(display, wanted.data(), &config, 1, &count);
    return count > 0 ? config : EGL_NO_CONFIG_KHR;
}

} // namespace

SharedDisplay::SharedDisplay(const EglCandidate& candidate) {
    const std::scoped_lock lock(displayUsers().mutex);
    display_ = eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
    if (display_ == EGL_NO_DISPLAY) {
        throw GpuError("EGL " + candidate.name, "it gives no display: " + eglErrorName(eglGetError()));
    }
    EGLint major = 0;
    EGLint minor = 0;
    if (eglInitialize(display_, &major, &minor) != EGL_TRUE) {
        throw GpuError("EGL " + candidate.name, "it cannot be initialised: " + eglErrorName(eglGetError()));
    }
    ++displayUsers().counts[display_];
}

SharedDisplay::~SharedDisplay() {
    const std::scoped_lock lock(displayUsers().mutex);
    auto& counts = displayUsers().counts;
    const auto users = counts.find(display_);
    if (users != counts.end() && --users->second == 0) {
        counts.erase(users);
        eglTerminate(display_);
    }
}

EglContext::EglContext(const EglCandidate& candidate) : name_(candidate.name), display_(candidate) {
    create();
    try {
        makeCurrent();
    } catch (...) {
        eglDestroyContext(display_.handle(), context_);
        throw;
    }
}

void EglContext::create() {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) throw GpuError("EGL " + name_, "it has no desktop OpenGL");
    const EGLConfig config = chooseConfig(display_.handle());
    for (const Wish& wish : kWishes) {
        context_ =
            eglCreateContext(display_.handle(), config, EGL_NO_CONTEXT, contextAttributes(wish).data());
        if (context_ == EGL_NO_CONTEXT) continue;
        robust_ = wish.resetNotification;
        return;
    }
    throw GpuError("EGL " + name_, "it gives no OpenGL 4.5 core context: " + eglErrorName(eglGetError()));
}

EglContext::~EglContext() {
    if (eglGetCurrentContext() == context_) releaseCurrent();
    eglDestroyContext(display_.handle(), context_);
}

void EglContext::makeCurrent() const {
    if (eglMakeCurrent(display_.handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
        throw GpuError("EGL " + name_, "its context cannot be made current without a surface: " +
                                           eglErrorName(eglGetError()));
    }
}

void EglContext::releaseCurrent() const {
    eglMakeCurrent(display_.handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

} // namespace voxsheet::gpu
