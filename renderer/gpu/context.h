// An OpenGL 4.5 core context with no window and no display, and the books of the GL objects made in it.
//
// All of voxsheet::gpu belongs to the one thread on which the Context is current: every object is made, used
// and destroyed there, and destroyed before its Context. Pixel rows are unpacked tightly (GL_UNPACK_ALIGNMENT
// 1): leave it so.
#pragma once

#include "gpu/render_device.h"
#include "gpu/workarounds.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <memory>
#include <string_view>

namespace voxsheet::gpu {

class EglContext;

/// Live GL objects of one context, for leak tests and for exact byte accounting.
struct ObjectCounts {
    int buffers = 0;
    int textures = 0;
    int samplers = 0;
    int programs = 0;
    int framebuffers = 0;
    int vertexArrays = 0;
    int queries = 0;
    std::uint64_t bufferBytes = 0;
    std::uint64_t textureBytes = 0;

    bool operator==(const ObjectCounts&) const = default;
};

struct Limits {
    int textureSize2d = 0;
    int textureSize3d = 0;
    int textureUnits = 0;               ///< of one compute shader
    std::int64_t storageBlockBytes = 0; ///< GL_MAX_SHADER_STORAGE_BLOCK_SIZE
};

class Context {
public:
    /// Makes a context and makes it current on the calling thread.
    /// \param deviceIndex  index into listRenderDevices(), or -1: the first hardware device with OpenGL 4.5
    /// core, else a
    ///                     software device, else EGL_PLATFORM_SURFACELESS_MESA.
    /// Throws GpuError when there is none (the text names the packages to install), InvalidInput (field
    /// "device") for an index that does not exist.
    explicit Context(int deviceIndex = -1);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    [[nodiscard]] const RenderDevice& device() const { return device_; }
    [[nodiscard]] const Limits& limits() const { return limits_; }
    [[nodiscard]] const Workarounds& workarounds() const { return workarounds_; }
    [[nodiscard]] const ObjectCounts& counts() const { return counts_; }
    [[nodiscard]] ObjectCounts& mutableCounts() { return counts_; } ///< for the classes of this room only

    void makeCurrent() const;
    void releaseCurrent() const;

    /// Call between raster work (draws, framebuffer clears) and a compute dispatch that touches the same
    /// texture. Waits for the raster work where the driver would run the two out of order
    /// (Workarounds::clearBeforeCompute).
    void settleRaster() const;

    /// Throws GpuError naming `doing` ("drawing a tile") and the GL errors that are pending; LimitExceeded
    /// when one of them is GL_OUT_OF_MEMORY.
    void checkErrors(std::string_view doing) const;
    /// Throws GpuError when the GPU was reset since the context was made: nothing of it can be used any more.
    void checkReset() const;

private:
    void choose(int deviceIndex);
    void describe();

    std::unique_ptr<EglContext> egl_;
    RenderDevice device_;
    Limits limits_;
    Workarounds workarounds_;
    ObjectCounts counts_;
};

} // namespace voxsheet::gpu
