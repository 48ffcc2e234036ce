#include "image/measured_hits.h"

#include "fields/sampled_field.h"
#include "volume/transfer_function.h"

#include <cmath>
#include <string>

namespace voxsheet::image {
namespace {

constexpr double kReachRadii = 1.05; ///< of the measured cube about the volume, each way
constexpr int kWindows = 4;          ///< per axis
constexpr int kWindowSteps = 8192;   ///< entries of a window's table
constexpr int kCubeSamples = 64;     ///< per axis: GPUs place a point to 1/256 of their distance only

/// Samples from face to face of a cube about the grid's box.
Grid cubeAround(const Grid& grid) {
    const double reach = kReachRadii * boundingRadiusWorld(grid);
    Grid cube;
    cube.dims = glm::ivec3(kCubeSamples);
    cube.worldFromIndex = glm::dmat4(2.0 * reach / (kCubeSamples - 1));
    cube.worldFromIndex[3] = glm::dvec4(centreWorld(grid) - reach, 1.0);
    return cube;
}

/// 0 to 1 along one axis of the cube, as a dataset; its key.
std::string addAxis(TilePainter& painter, const Grid& cube, const TileSpec& tile, int axis) {
    fields::AnalyticField ramp;
    ramp.name = "axis";
    // The first and the last sample sit at -low and low of sampleField's cube.
    constexpr double low = 1.0 - 1.0 / kCubeSamples;
    ramp.value = [axis](const glm::dvec3& p) { return 0.5 * p[axis] / low + 0.5; };
    const auto key = "axis " + std::to_string(axis) + " about " + tile.dataset;
    auto sampled = fields::sampleField(ramp, cube, ScalarType::F32, key);
    painter.volumes().add(std::move(sampled.meta), std::move(sampled.arrays));
    return key;
}

std::shared_ptr<const TransferTable> windowTable(int window) {
    TransferFunction ramp;
    ramp.colours = {{0.0, glm::dvec3(0.0)}, {1.0, glm::dvec3(1.0)}};
    ramp.opacities = {{0.0, 1.0}};
    ramp.low = double(window) / kWindows;
    ramp.high = double(window + 1) / kWindows;
    return buildTransferTable(ramp, kWindowSteps);
}

void makeOpaque(TileSpec& tile) {
    for (auto& surface : tile.isosurface.surfaces)
        surface.colour = glm::vec4(1.0F);
}

} // namespace

double measuredPositionError(const Grid& grid) {
    const double step = 2.0 * kReachRadii * boundingRadiusWorld(grid) / kWindows / (kWindowSteps - 1);
    return 0.5 * std::sqrt(3.0) * step;
}

std::vector<fields::FirstHit> measuredPositions(TilePainter& painter, TileSpec tile) {
    const auto cube = cubeAround(painter.provider().describe(tile.dataset)->grid);
    makeOpaque(tile);
    tile.shading.enabled = false;
    const double edge = cube.worldFromIndex[0][0] * (kCubeSamples - 1);
    std::vector<fields::FirstHit> hits;
    for (int axis = 0; axis < 3; ++axis) {
        const auto key = addAxis(painter, cube, tile, axis);
        for (int window = 0; window < kWindows; ++window) {
            tile.isosurface.colouredBy = ColourVolume{key, 0, 0, 0, windowTable(window)};
            const auto picture = painter.draw(tile);
            hits.resize(picture.pixels.size());
            for (std::size_t i = 0; i < hits.size(); ++i) {
                const auto& pixel = picture.pixels[i];
                if (!(pixel.w > 0.5)) continue;
                hits[i].surface = 0;
                if (pixel.x > 0.0 || window == 0) // else it lies before this window
                    hits[i].position[axis] =
                        cube.worldFromIndex[3][axis] + edge * (window + pixel.x) / kWindows;
            }
        }
    }
    return hits;
}

std::vector<fields::FirstHit> measuredNormals(TilePainter& painter, TileSpec tile) {
    makeOpaque(tile);
    tile.isosurface.colouredBy.reset();
    auto& shading = tile.shading;
    shading.enabled = true;
    shading.ambient = 0.0;
    shading.diffuse = 1.0;
    shading.specular = 0.0;
    shading.headLight = 0.0;
    shading.lightIntensity = 1.0;
    const auto worldFromView = glm::transpose(glm::dmat3(tile.camera.viewFromWorld));
    std::vector<fields::FirstHit> hits;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 light(0.0);
            light[axis] = side;
            shading.lightsView = {light};
            const auto picture = painter.draw(tile);
            hits.resize(picture.pixels.size());
            for (std::size_t i = 0; i < hits.size(); ++i)
                if (picture.pixels[i].w > 0.5) {
                    hits[i].surface = 0;
                    hits[i].normal += worldFromView * (picture.pixels[i].x * light);
                }
        }
    for (auto& hit : hits)
        if (hit.surface >= 0) hit.normal = glm::normalize(hit.normal);
    return hits;
}

} // namespace voxsheet::image
