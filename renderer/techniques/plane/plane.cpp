#include "techniques/plane/plane.h"

#include "base/errors.h"
#include "stages/banded_dispatch.h"

#include <cmath>

namespace voxsheet {
namespace {

/// Cosine between line of sight and normal below which nothing of the plane can be told apart.
constexpr double kEdgeOn = 1e-9;
/// Of the texture frame: rounding of the camera, which must not make pixels of one row of samples differ.
constexpr double kRounding = 1e-12;

glm::dvec3 withoutRounding(glm::dvec3 v) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(v[axis]) < kRounding) v[axis] = 0.0;
    return v;
}

} // namespace

std::optional<PlaneInPicture> planeInPicture(const PlaneSpec& plane, const RayFrame& frame,
                                             const Grid& grid) {
    const auto worldFromTextures = worldFromTexture(grid);
    const glm::dvec3 normal = glm::transpose(glm::dmat3(worldFromTextures)) * plane.normal;
    const double offset = plane.offset - glm::dot(plane.normal, glm::dvec3(worldFromTextures[3]));
    const double advance = glm::dot(normal, frame.direction);
    if (std::abs(advance) < kEdgeOn * frame.radiusWorld) return std::nullopt;
    const auto alongSight = [&](const glm::dvec3& point, double distance) {
        return point + (distance - glm::dot(normal, point)) / advance * frame.direction;
    };
    return PlaneInPicture{alongSight(frame.origin, offset), withoutRounding(alongSight(frame.originX, 0.0)),
                          withoutRounding(alongSight(frame.originY, 0.0))};
}

void drawPlane(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    if (frame.perspective)
        throw InvalidInput("camera", "a plane is drawn with parallel lines of sight",
                           "choose the orthographic projection")
            .withField("camera.projection");
    const auto& volume = volumes.volume;
    auto defines =
        ClassificationStage::defines(*tile.transfer, volume, stages.filterFloatsInShader, tile.categories);
    defines.emplace_back("CLIP_PLANES", "0");
    const bool nearest = tile.categories || tile.plane.interpolation == PlaneInterpolation::Nearest;
    defines.emplace_back("NEAREST", nearest ? "1" : "0");
    defines.emplace_back("CATEGORIES", tile.categories ? "1" : "0");
    const auto layers = LayerStage::defines(tile, volumes.layers, stages.filterFloatsInShader);
    defines.insert(defines.end(), layers.begin(), layers.end());
    defines.emplace_back("SHADING", "0");
    defines.emplace_back("SKIP_EMPTY", "0");
    defines.emplace_back("SOLIDS", volumes.solids != nullptr ? "1" : "0");
    const auto& program = stages.programs.compute("techniques/plane/plane.glsl", defines);

    stages.classification.bind(program, tile.transfer, volume);
    LayerStage::bind(program, tile, volume, volumes.layers, stages.classification);
    setRayUniforms(program, frame, tile.sizePixels);
    if (volumes.solids != nullptr) volumes.solids->bind(solidsUnit);
    const auto onPlane = planeInPicture(tile.plane, frame, placedGrid(volume.meta->grid, tile.periodic));
    const PlaneInPicture picture = onPlane.value_or(PlaneInPicture{});
    program.set("planeSeen", onPlane ? 1.0F : 0.0F);
    program.set("planeOrigin", glm::vec3(picture.origin));
    program.set("planeRight", glm::vec3(picture.right));
    program.set("planeUp", glm::vec3(picture.up));
    program.set("nanColour", tile.transfer->nan);
    target->bindImage(0, GL_WRITE_ONLY);
    constexpr double samplesPerPixel = 1.0;
    dispatchPicture(program, tile.sizePixels, samplesPerPixel, rows);
}

} // namespace voxsheet
