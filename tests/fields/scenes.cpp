#include "fields/scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace voxsheet::fields {
namespace {

constexpr double kFovDegrees = 30.0;

TransferFunction rainbow(double low, double high) {
    TransferFunction function;
    function.colours = {
        {0.0, {0.1, 0.2, 0.9}}, {0.35, {0.1, 0.8, 0.7}}, {0.6, {0.9, 0.8, 0.2}}, {1.0, {0.9, 0.15, 0.1}}};
    function.low = low;
    function.high = high;
    return function;
}

} // namespace

const char* nameOf(Geometry geometry) {
    switch (geometry) {
    case Geometry::Isotropic:
        return "isotropic";
    case Geometry::Anisotropic:
        return "anisotropic";
    case Geometry::Sheared:
        break;
    }
    return "sheared";
}

const char* nameOf(Technique technique) { return techniqueName(technique); }

const char* nameOf(Projection projection) {
    return projection == Projection::Perspective ? "perspective" : "orthographic";
}

Grid gridOf(Geometry geometry, int samples) {
    Grid grid;
    grid.dims = glm::ivec3(samples);
    switch (geometry) {
    case Geometry::Isotropic:
        break;
    case Geometry::Anisotropic:
        grid.worldFromIndex = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.7, 1.6));
        break;
    case Geometry::Sheared:
        grid.worldFromIndex[0] = {1.0, 0.1, 0.0, 0.0};
        grid.worldFromIndex[1] = {0.45, 0.9, 0.1, 0.0};
        grid.worldFromIndex[2] = {-0.3, 0.25, 1.2, 0.0};
        grid.worldFromIndex[3] = {5.0, -3.0, 11.0, 1.0};
        break;
    }
    return grid;
}

std::shared_ptr<const TransferTable> filledTable(double low, double high) {
    auto function = rainbow(low, high);
    function.opacities = {{0.0, 0.004}, {0.3, 0.02}, {0.7, 0.05}, {1.0, 0.12}};
    return buildTransferTable(function);
}

std::shared_ptr<const TransferTable> sparseTable(double low, double high) {
    auto function = rainbow(low, high);
    function.opacities = {{0.0, 0.0}, {0.55, 0.0}, {0.65, 0.15}, {1.0, 0.3}};
    return buildTransferTable(function);
}

std::shared_ptr<const TransferTable> peaksTable(double low, double high) {
    auto function = rainbow(low, high);
    constexpr double halfWidth = 0.006;
    for (const double peak : {0.2, 0.45, 0.7}) {
        function.opacities.push_back({peak - halfWidth, 0.0});
        function.opacities.push_back({peak, 0.6});
        function.opacities.push_back({peak + halfWidth, 0.0});
    }
    return buildTransferTable(function);
}

CameraSpec cameraOf(const Grid& grid, Projection projection, double azimuthDegrees, double elevationDegrees) {
    const double azimuth = glm::radians(azimuthDegrees);
    const double elevation = glm::radians(elevationDegrees);
    const glm::dvec3 from(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                          std::cos(elevation) * std::cos(azimuth));
    const auto centre = centreWorld(grid);
    const double radius = boundingRadiusWorld(grid);
    CameraSpec camera;
    camera.projection = projection;
    camera.fovYDegrees = kFovDegrees;
    camera.heightWorld = 1.8 * radius;
    const double distance = 0.9 * radius / std::sin(glm::radians(0.5 * kFovDegrees));
    camera.viewFromWorld = glm::lookAt(centre + distance * from, centre, glm::dvec3(0.0, 1.0, 0.0));
    return camera;
}

TileSpec tileOf(const std::string& key, const Grid& grid, Technique technique, int pixels) {
    TileSpec tile;
    tile.dataset = key;
    tile.technique = technique;
    tile.sizePixels = glm::ivec2(pixels);
    tile.unitLengthWorld = meanVoxelEdgeWorld(grid);
    tile.camera = cameraOf(grid, Projection::Perspective);
    tile.background = glm::vec4(0.0F);
    return tile;
}

} // namespace voxsheet::fields
