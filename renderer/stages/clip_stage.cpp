#include "stages/clip_stage.h"

#include "base/errors.h"
#include "stages/gradient_frame.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {
namespace {

constexpr double kSmallest = 1e-37; ///< of normal 32-bit floats, nearly
constexpr float kFar = 1e6F;        ///< in texture frames: beyond any picture

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

/// In the texture frame of the distances; distances beyond the ends are those at the ends.
struct KeptBox {
    glm::vec3 low{-kFar};
    glm::vec3 high{kFar};
};

/// Of a probe: around all bricks that have something inside.
KeptBox insideBox(const ResidentVolume& object) {
    KeptBox box{glm::vec3(kFar), glm::vec3(-kFar)};
    const auto& bricks = object.minMax->bricks;
    const auto brickSamples = static_cast<float>(MinMaxGrid::brickSamplesFor(object.dims));
    auto range = object.minMax->ranges.begin();
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x, ++range) {
                if (!(range->low < 0.0F)) continue;
                const glm::ivec3 brick(x, y, z);
                for (int axis = 0; axis < 3; ++axis) {
                    const float width = brickSamples / static_cast<float>(object.dims[axis]);
                    const float low = brick[axis] == 0 ? -kFar : width * static_cast<float>(brick[axis]);
                    const float high =
                        brick[axis] + 1 == bricks[axis] ? kFar : width * static_cast<float>(brick[axis] + 1);
                    box.low[axis] = std::min(box.low[axis], low);
                    box.high[axis] = std::max(box.high[axis], high);
                }
            }
    return box;
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

ClipObjectFrame clipObjectFrame(const TileSpec& tile, const Grid& grid, const ResidentVolume& object) {
    const auto& clip = *tile.clip.object;
    const auto& objectGrid = object.meta->grid;
    const auto objectFromTexture = clip.objectFromWorld * worldFromTexture(grid);
    const bool probe = clip.mode == ClipMode::Probe;
    const double sign = probe ? -1.0 : 1.0;
    // Inside is below 0: a probe does not keep distances of exactly 0, which samples on a surface have.
    const double onSurface = probe ? -kSmallest : 0.0;
    const auto kept = probe ? insideBox(object) : KeptBox{};
    const auto viewFromObject =
        glm::dmat3(tile.camera.viewFromWorld) * glm::inverse(glm::dmat3(clip.objectFromWorld));
    ClipObjectFrame frame;
    frame.clipFromTexture = glm::mat4(glm::inverse(worldFromTexture(objectGrid)) * objectFromTexture);
    frame.objectFromTexture = glm::mat3(objectFromTexture);
    frame.measureFromTexel = glm::dvec2(sign * object.valueScale, sign * object.valueOffset + onSurface);
    // Interpolants and nearest samples of true distances are off by at most half a voxel's diagonal, at both
    // ends.
    frame.nearestSampleSlack = static_cast<float>(glm::length(spacingWorld(objectGrid)));
    frame.viewFromClipGradient = viewFromGradient(viewFromObject * glm::dmat3(objectGrid.worldFromIndex));
    frame.keptLow = kept.low;
    frame.keptHigh = kept.high;
    return frame;
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
    object->texture->bind(distanceUnit);
    const auto frame = clipObjectFrame(tile, grid, *object);
    program.set("clipFromTexture", frame.clipFromTexture);
    program.set("objectFromTexture", frame.objectFromTexture);
    program.set("measureFromTexel", frame.measureFromTexel);
    program.set("clipTexelSize", 1.0F / glm::vec3(object->dims));
    program.set("clipKeptLow", frame.keptLow);
    program.set("clipKeptHigh", frame.keptHigh);
    program.set("nearestSampleSlack", frame.nearestSampleSlack);
    program.set("viewFromClipGradient", frame.viewFromClipGradient);
}

} // namespace voxsheet
