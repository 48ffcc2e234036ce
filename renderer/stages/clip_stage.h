// Clip planes and clip objects as the shaders read them (kept_span.glsl, clip_object.glsl).
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"
#include "residency/residency_manager.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace voxsheet {

/// (n, w) per plane: dot(n, t) + w >= 0 is kept, t in the texture frame of `grid`, |n| = 1.
[[nodiscard]] std::vector<glm::vec4> clipPlanesInTexture(const std::vector<ClipPlane>& planes,
                                                         const Grid& grid);

/// Throws InvalidInput (with field clip.planes or clip.shape) if there are too many planes, a normal does not
/// have unit length, a number is not finite, or the object's matrix is not affine and invertible.
void validateClip(const ClipSpec& clip);

/// A clip object as shaders and kernels read it; names and meanings as in clip_object.glsl.
struct ClipObjectFrame {
    glm::mat4 clipFromTexture{1.0F};
    glm::mat3 objectFromTexture{1.0F};
    glm::vec2 measureFromTexel{1.0F, 0.0F};
    float nearestSampleSlack = 0.0F;
    glm::mat3 viewFromClipGradient{1.0F};
    glm::vec3 keptLow{0.0F};
    glm::vec3 keptHigh{0.0F};
};

/// \param grid  of the volume that is cut
[[nodiscard]] ClipObjectFrame clipObjectFrame(const TileSpec& tile, const Grid& grid,
                                              const ResidentVolume& object);

class ClipStage {
public:
    static constexpr GLuint distanceUnit = 3;

    /// \param object         the resident distances of clip.object, or null
    /// \param filterFloats   the shader interpolates 32-bit floats itself
    [[nodiscard]] static gpu::ShaderDefines defines(const ClipSpec& clip, const ResidentVolume* object,
                                                    bool filterFloats);
    /// Binds the distances and sets the uniforms.
    static void bind(const gpu::Program& program, const TileSpec& tile, const Grid& grid,
                     const ResidentVolume* object);
};

} // namespace voxsheet
