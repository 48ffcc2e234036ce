// Named workarounds for driver faults. Each is on for the drivers that need it, and can be switched off for
// trials by the environment: VOXSHEET_DISABLE_WORKAROUNDS=clear-before-compute,r8-as-r16
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::gpu {

struct Workarounds {
    /// "clear-before-compute": llvmpipe (Mesa 22.3) may run a queued glClear of a framebuffer after a compute
    /// dispatch that writes the same texture; Context::settleRaster waits in between.
    bool clearBeforeCompute = false;
    /// "r8-as-r16": llvmpipe filters R8 textures in 8-bit fixed point (256 levels out); 8-bit volumes become
    /// R16.
    bool r8AsR16 = false;
    /// "coarse-filter-weights": GPUs weigh the samples of a filtered texel in steps of 1/256 voxel, which
    /// moves grazing hits by half a voxel (seen on an NVIDIA H200); isosurfaces refine roots by interpolation
    /// of their own.
    bool coarseFilterWeights = false;

    /// "simd-rays": llvmpipe gathers every texel and every uniform lane by lane; rays are marched by kernels
    /// of our own instead (simd/kernels.h), which read volumes from host memory.
    bool simdRays = false;

    bool operator==(const Workarounds&) const = default;
};

/// What `renderer` (GL_RENDERER) needs, less the names in the comma-separated list `disabled`.
/// Throws InvalidInput (field VOXSHEET_DISABLE_WORKAROUNDS) on a name that is not known.
[[nodiscard]] Workarounds workaroundsFor(std::string_view renderer, std::string_view disabled);

[[nodiscard]] std::vector<std::string> workaroundNames(const Workarounds& workarounds);
/// The inverse; other names are left out.
[[nodiscard]] Workarounds workaroundsNamed(const std::vector<std::string>& names);

} // namespace voxsheet::gpu
