#include "stages/clip_stage.h"

#include "base/errors.h"
#include "stages/gradient_frame.h"

#include <cmath>

namespace voxsheet {
namespace {

constexpr double kSmallest = 1e-37; ///< of normal 32-bit floats, nearly

bool isAffineAndInvertible(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    const bool affine =
        matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] == 1.0;
    const glm::dmat3 linear(matrix);
    const double scale = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    return affine && std::abs(glm::determinant(linear)) > 1e-9 * scale;
}

} // namespace

std::vector<glm::vec4> clipPlanesInTexture(const std::vector<ClipPlane>& planes, const Grid& grid) {
    const auto worldFromTex = worldFromTexture(grid);
    std::vector<glm::vec4> inTexture;
    for (const auto& plane : planes) {
        const auto normal = glm::transpose(glm::dmat3(worldFromTex)) * plane.normal;
        const double offset = glm::dot(plane.normal, glm::dvec3(worldFromTex[3])) - plane.offset;
        const double length = glm::length(normal);
        inTexture.emplace_back(glm::dvec4(normal, offset) / length);
    }
    return inTexture;
}

void validateClip(const ClipSpec& clip) {
    if (clip.planes.size() > kMaxClipPlanes)
        throw InvalidInput("clip planes", "there are more than " + std::to_string(kMaxClipPlanes))
            .withField("clip.planes");
    for (const auto& plane : clip.planes)
        if (!std::isfinite(plane.offset) || !(std::abs(glm::length(plane.normal) - 1.0) < 1e-6))
            throw InvalidInput("clip plane",
                               "its normal does not have unit length, or a number is not finite")
                .withField("clip.planes");
    if (clip.object && !isAffineAndInvertible(clip.object->objectFromWorld))
        throw InvalidInput("clip object", "its matrix is not affine and invertible")
            .withField("clip.transform");
}

gpu::ShaderDefines ClipStage::defines(const ClipSpec& clip, const ResidentVolume* object, bool filterFloats) {
    const char* kind = object == nullptr ? "0" : clip.object->binary ? "2" : "1";
    const bool filter = object != nullptr && filterFloats && object->texture->internalFormat() == GL_R32F;
    return {{"CLIP_PLANES", clip.planes.empty() ? "0" : "1"},
            {"CLIP_OBJECT", kind},
            {"CLIP_FILTER", filter ? "1" : "0"}};
}

void ClipStage::bind(const gpu::Program& program, const TileSpec& tile, const Grid& grid,
                     const ResidentVolume* object) {
    const auto planes = clipPlanesInTexture(tile.clip.planes, grid);
    program.set("clipPlaneCount", static_cast<int>(planes.size()));
    program.set("clipPlanes", planes);
    if (object == nullptr) return;
    const auto& clip = *tile.clip.object;
    const auto& objectGrid = object->meta->grid;
    object->texture->bind(distanceUnit);
    const auto objectFromTexture = clip.objectFromWorld * worldFromTexture(grid);
    program.set("clipFromTexture", glm::mat4(glm::inverse(worldFromTexture(objectGrid)) * objectFromTexture));
    program.set("objectFromTexture", glm::mat3(objectFromTexture));
    const bool probe = clip.mode == ClipMode::Probe;
    const double sign = probe ? -1.0 : 1.0;
    // Inside is below 0: a probe does not keep distances of exactly 0, which samples on a surface have.
    const double onSurface = probe ? -kSmallest : 0.0;
    program.set("measureFromTexel",
                glm::vec2(sign * object->valueScale, sign * object->valueOffset + onSurface));
    program.set("clipTexelSize", 1.0F / glm::vec3(object->dims));
    // Interpolants and nearest samples of true distances are off by at most half a voxel's diagonal, at both
    // ends.
    program.set("nearestSampleSlack", static_cast<float>(glm::length(spacingWorld(objectGrid))));
    const auto viewFromObject =
        glm::dmat3(tile.camera.viewFromWorld) * glm::inverse(glm::dmat3(clip.objectFromWorld));
    program.set("viewFromClipGradient",
                viewFromGradient(viewFromObject * glm::dmat3(objectGrid.worldFromIndex)));
}

} // namespace voxsheet
