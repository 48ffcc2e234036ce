#include "gpu/context.h"

#include "base/errors.h"
#include "base/log.h"
#include "gpu/egl_context.h"
#include "gpu/texture_budget.h"

#include <cstdlib>
#include <optional>

namespace voxsheet::gpu {

namespace {

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

int glInteger(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

const char* glErrorName(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_STACK_UNDERFLOW:
        return "GL_STACK_UNDERFLOW";
    case GL_STACK_OVERFLOW:
        return "GL_STACK_OVERFLOW";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown GL error";
    }
}

void GLAPIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                               const GLchar* message, const void*) {
    const std::string text =
        "OpenGL: " +
        (length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length)));
    if (type == GL_DEBUG_TYPE_ERROR) {
        logMessage(LogLevel::Error, text);
    } else if (severity == GL_DEBUG_SEVERITY_HIGH) {
        logMessage(LogLevel::Warning, text);
    } else {
        logMessage(LogLevel::Debug, text);
    }
}

void routeDebugOutput() {
    glEnable(GL_DEBUG_OUTPUT);
    glDebugMessageCallback(onDebugMessage, nullptr);
    // Notifications are the driver's running commentary ("buffer will use video memory …").
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
}

struct Choice {
    std::unique_ptr<EglContext> egl;
    std::string reason;
};

Choice chooseNamed(const std::vector<EglCandidate>& candidates, int index) {
    if (index >= static_cast<int>(candidates.size())) {
        throw InvalidInput("device " + std::to_string(index),
                           "this machine has " + std::to_string(candidates.size()) + " render devices",
                           "choose 0 to " + std::to_string(candidates.size() - 1))
            .withField("device");
    }
    Choice choice;
    choice.egl = std::make_unique<EglContext>(candidates[static_cast<std::size_t>(index)]);
    choice.reason = "It was asked for as device " + std::to_string(index) + ".";
    return choice;
}

Choice chooseBest(const std::vector<EglCandidate>& candidates) {
    Choice software;
    std::string failures;
    for (const EglCandidate& candidate : candidates) {
        try {
            auto egl = std::make_unique<EglContext>(candidate);
            if (!isSoftwareRenderer(glText(GL_RENDERER))) {
                return {std::move(egl), "It is the first of " + std::to_string(candidates.size()) +
                                            " EGL devices that is hardware with OpenGL 4.5 core."};
            }
            if (!software.egl) software.egl = std::move(egl);
        } catch (const GpuError& error) {
            failures += (failures.empty() ? "" : "; ") + candidate.name + ": " + error.why();
        }
    }
    if (!software.egl) {
        throw GpuError(
            "OpenGL", "no EGL device gives an OpenGL 4.5 core context (" + failures + ")",
            "install the packages libegl1 libgl1-mesa-dri for software rendering, or the GPU's driver");
    }
    software.egl->makeCurrent(); // a later candidate's probe may have displaced it
    software.reason = "No EGL device is hardware with OpenGL 4.5 core" +
                      (failures.empty() ? std::string() : " (" + failures + ")") + ", so software draws.";
    return software;
}

} // namespace

Context::Context(int deviceIndex) {
    choose(deviceIndex);
    describe();
    routeDebugOutput();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    checkErrors("setting up the context");
}

Context::~Context() = default;

void Context::choose(int deviceIndex) {
    const auto candidates = eglCandidates();
    Choice choice = deviceIndex >= 0 ? chooseNamed(candidates, deviceIndex) : chooseBest(candidates);
    egl_ = std::move(choice.egl);
    device_.reason = std::move(choice.reason);
}

void Context::describe() {
    device_.renderer = glText(GL_RENDERER);
    device_.vendor = glText(GL_VENDOR);
    device_.version = glText(GL_VERSION);
    device_.eglPlatform = egl_->name();
    device_.software = isSoftwareRenderer(device_.renderer);
    device_.robust = egl_->robust();
    limits_.textureSize2d = glInteger(GL_MAX_TEXTURE_SIZE);
    limits_.textureSize3d = glInteger(GL_MAX_3D_TEXTURE_SIZE);
    limits_.textureUnits = glInteger(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS);
    GLint64 storageBlockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storageBlockBytes);
    limits_.storageBlockBytes = storageBlockBytes;
    device_.maxTextureSize3d = limits_.textureSize3d;
    const TextureMemory memory = textureMemory(device_.software);
    device_.memoryBytes = memory.deviceBytes;
    device_.textureBudgetBytes = memory.defaultBudget;
    device_.textureBudgetReason = memory.reason;
    const char* disabled = std::getenv("VOXSHEET_DISABLE_WORKAROUNDS");
    workarounds_ = workaroundsFor(device_.renderer, disabled == nullptr ? "" : disabled);
    device_.workarounds = workaroundNames(workarounds_);
}

void Context::makeCurrent() const { egl_->makeCurrent(); }
void Context::releaseCurrent() const { egl_->releaseCurrent(); }

void Context::settleRaster() const {
    if (workarounds_.clearBeforeCompute) glFinish();
}

void Context::checkErrors(std::string_view doing) const {
    std::string names;
    bool outOfMemory = false;
    // A lost context reports GL_CONTEXT_LOST for ever: stop after a few.
    for (int i = 0; i < 8; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        outOfMemory = outOfMemory || error == GL_OUT_OF_MEMORY;
        names += (names.empty() ? "" : ", ") + std::string(glErrorName(error));
        if (error == GL_CONTEXT_LOST) break;
    }
    if (names.empty()) return;
    if (outOfMemory) {
        throw LimitExceeded(std::string(doing), "the render device has no memory left (" + names + ")",
                            "lower the texture budget, or draw a coarser level");
    }
    throw GpuError(std::string(doing), names);
}

void Context::checkReset() const {
    if (!device_.robust) return;
    const GLenum status = glGetGraphicsResetStatus();
    if (status == GL_NO_ERROR) return;
    const char* cause = "for an unknown cause";
    if (status == GL_GUILTY_CONTEXT_RESET) cause = "because of our work, probably a draw that took too long";
    if (status == GL_INNOCENT_CONTEXT_RESET) cause = "because of another program";
    throw GpuError(device_.renderer, std::string("the GPU was reset ") + cause,
                   "draw again; if it recurs, draw smaller pictures or choose another device");
}

} // namespace voxsheet::gpu
