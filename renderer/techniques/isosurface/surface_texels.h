// The isovalues of a picture as texels of a volume: what shaders and kernels compare with.
#pragma once

#include "residency/resident_volume.h"
#include "stages/isosurface_spec.h"

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet {

struct SurfaceTexels {
    std::vector<double> values; ///< of the surfaces, in the order of their texels, which rise
    std::vector<float> texels;
    std::vector<glm::vec4> colours; ///< not premultiplied
    /// (s, t): a texel is inside when s * texel >= t.
    glm::vec2 cap{0.0F};
    glm::vec2 mirroredCap{0.0F};     ///< the same for negative values; never true when there are none
    float plainTestTolerance = 0.0F; ///< half of 1/64 of the range: what the plain test takes for equal
};

[[nodiscard]] SurfaceTexels surfaceTexels(const IsosurfaceSpec& spec, const ResidentVolume& volume);

} // namespace voxsheet
