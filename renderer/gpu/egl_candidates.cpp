#include "base/errors.h"
#include "gpu/egl_context.h"
#include "gpu/render_device.h"

#include <epoxy/gl.h>

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <thread>

namespace voxsheet::gpu {

namespace {

constexpr const char* kInstall =
    "install the packages libegl1 libopengl0 libgl1-mesa-dri, or the GPU vendor's driver with EGL";

bool canLoad(std::initializer_list<const char*> libraries) {
    return std::any_of(libraries.begin(), libraries.end(), [](const char* library) {
        // Stays loaded: libepoxy loads the same library, and ends the process when it cannot.
        return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr;
    });
}

void requireLibraries() {
    if (!canLoad({"libEGL.so.1"})) throw GpuError("EGL", "libEGL.so.1 cannot be loaded", kInstall);
    if (!canLoad({"libOpenGL.so.0", "libGL.so.1"})) {
        throw GpuError("OpenGL", "neither libOpenGL.so.0 nor libGL.so.1 can be loaded", kInstall);
    }
}

std::string deviceName(std::size_t index, EGLDeviceEXT device) {
    std::string name = "device " + std::to_string(index);
    const char* text = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    const std::string extensions = text == nullptr ? "" : text;
    const char* detail = nullptr;
    if (extensions.find("EGL_EXT_device_drm") != std::string::npos) {
        detail = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT);
    }
    if (detail == nullptr && extensions.find("EGL_MESA_device_software") != std::string::npos)
        detail = "Mesa software";
    return detail == nullptr ? name : name + " (" + detail + ")";
}

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

std::vector<std::string> describeCandidates() {
    std::vector<std::string> lines;
    for (const EglCandidate& candidate : eglCandidates()) {
        std::string line = std::to_string(lines.size()) + ": " + candidate.name + ": ";
        try {
            const EglContext context(candidate);
            const std::string renderer = glText(GL_RENDERER);
            line += renderer + ", OpenGL " + glText(GL_VERSION);
            if (isSoftwareRenderer(renderer)) line += ", software";
        } catch (const GpuError& error) {
            line += "not usable, " + error.why();
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace

std::vector<EglCandidate> eglCandidates() {
    requireLibraries();
    std::vector<EglCandidate> candidates;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
        std::array<EGLDeviceEXT, 64> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
                candidates.push_back({deviceName(i, devices[i]), EGL_PLATFORM_DEVICE_EXT, devices[i]});
            }
        }
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        candidates.push_back({"surfaceless Mesa", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
    }
    if (candidates.empty()) {
        throw GpuError("EGL", "it offers neither devices nor the surfaceless platform", kInstall);
    }
    return candidates;
}

bool isSoftwareRenderer(const std::string& renderer) {
    std::string lower = renderer;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array kNames{"llvmpipe", "softpipe", "swrast", "software"};
    return std::any_of(kNames.begin(), kNames.end(),
                       [&](const char* name) { return lower.find(name) != std::string::npos; });
}

} // namespace voxsheet::gpu

namespace voxsheet {

std::vector<std::string> listRenderDevices() {
    std::vector<std::string> lines;
    // On a thread of its own: the probing contexts must not displace one that is current on the caller's.
    std::thread([&lines] {
        try {
            lines = gpu::describeCandidates();
        } catch (const GpuError&) {
            lines.clear(); // no EGL: no devices
        }
    }).join();
    return lines;
}

} // namespace voxsheet
