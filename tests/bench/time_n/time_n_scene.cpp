#include "bench/time_n/time_n_scene.h"

#include "base/errors.h"
#include "fields/scenes.h"
#include "volume/clip_shapes.h"

namespace voxsheet::bench {

namespace {

constexpr double kFirstDegrees = 30.0;
constexpr double kDegreesPerFrame = 2.0;
constexpr double kElevationDegrees = 25.0;

/// The same table for every tile of every frame, so that it is made once.
const std::shared_ptr<const TransferTable>& blobs() {
    static const auto table = fields::sparseTable(0.0, 1.0);
    return table;
}

void cutThroughCentre(TileSpec& tile, const Grid& grid) {
    const auto normal = glm::normalize(glm::dvec3(-0.6, -0.3, -1.0));
    tile.clip.planes = {{normal, glm::dot(normal, centreWorld(grid))}};
}

void clipToSphere(TileSpec& tile, const Grid& grid) {
    const double scale = 1.0 / (0.4 * (grid.dims.x - 1)); // its diameter is 0.8 of the box's edge
    ClipObject sphere;
    sphere.dataset = clipShapeKey(ClipShape::Sphere);
    sphere.mode = ClipMode::Probe;
    sphere.objectFromWorld = glm::dmat4(scale);
    sphere.objectFromWorld[3] = glm::dvec4(-scale * centreWorld(grid), 1.0);
    tile.clip.object = sphere;
}

} // namespace

TileSpec timeNTile(const TimeNScene& scene, const std::string& dataset, const Grid& grid, int level,
                   int frame) {
    auto tile = fields::tileOf(dataset, grid, Technique::Raycast, scene.tilePixels.y);
    tile.sizePixels = scene.tilePixels;
    tile.level = level;
    tile.transfer = blobs();
    tile.unitLengthWorld = grid.dims.x / 256.0; // the material keeps its looks at every size of the volume
    tile.camera = fields::cameraOf(grid, Projection::Perspective, kFirstDegrees + kDegreesPerFrame * frame,
                                   kElevationDegrees);
    tile.background = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    tile.shading.enabled = scene.shading;
    tile.shading.gradient = GradientSource::Texture;
    if (scene.technique == "sr") {
        tile.technique = Technique::Surface;
        cutThroughCentre(tile, grid);
    } else if (scene.technique == "vc") {
        clipToSphere(tile, grid);
    } else if (scene.technique == "ie") {
        tile.technique = Technique::Isosurface;
        tile.isosurface.surfaces = {{0.65, glm::vec4(0.9F, 0.7F, 0.4F, 1.0F)}};
    } else if (scene.technique != "vr") {
        throw InvalidInput("--technique", "\"" + scene.technique + "\" is not vr, sr, vc or ie")
            .withField("technique");
    }
    return tile;
}

} // namespace voxsheet::bench
