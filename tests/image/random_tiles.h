// Tiles with everything drawn by lot: grids, cameras, cuts, lights, surfaces, layers.
#pragma once

#include "image/inside_scene.h"

#include "volume/clip_shapes.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace voxsheet::image {

class RandomTiles : public InsideScene, public testing::WithParamInterface<Technique> {
protected:
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    bool coin(double chance = 0.5) { return number(0.0, 1.0) < chance; }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 p(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0));
            if (glm::length(p) > 0.1 && glm::length(p) < 1.0) return glm::normalize(p);
        }
    }

    Grid randomGrid() {
        auto grid = fields::gridOf(static_cast<fields::Geometry>(whole(0, 2)), 32);
        grid.dims = {whole(14, 34), whole(14, 34), whole(14, 34)};
        grid.periodic = {coin(0.3), coin(0.3), coin(0.3)};
        if (coin(0.3)) grid.centring = Centring::Cell;
        const double scale = std::pow(10.0, number(-3.0, 3.0));
        grid.worldFromIndex = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * grid.worldFromIndex;
        return grid;
    }

    CameraSpec randomCamera(const Grid& grid) {
        auto camera = fields::cameraOf(grid, coin() ? Projection::Perspective : Projection::Orthographic);
        const auto centre = centreWorld(grid);
        const double distance =
            boundingRadiusWorld(grid) * (coin(0.25) ? number(0.1, 0.9) : number(1.5, 4.0));
        camera.viewFromWorld =
            glm::lookAt(centre + distance * direction(),
                        centre + 0.2 * boundingRadiusWorld(grid) * direction(), direction());
        camera.fovYDegrees = number(25.0, 70.0);
        return camera;
    }

    ClipObject randomObject(const Grid& grid) {
        ClipObject object;
        const auto shape = static_cast<ClipShape>(whole(0, 4));
        object.dataset = clipShapeKey(shape);
        object.mode = coin() ? ClipMode::Probe : ClipMode::Clip;
        object.binary = coin(0.2);
        const double size = boundingRadiusWorld(grid) * number(0.3, 0.9);
        const auto place = centreWorld(grid) + 0.4 * boundingRadiusWorld(grid) * direction();
        const auto worldFromObject =
            glm::translate(glm::dmat4(1.0), place) *
            glm::rotate(glm::dmat4(1.0), number(0.0, 6.28), direction()) *
            glm::scale(glm::dmat4(1.0), size * glm::dvec3(1.0, number(0.7, 1.0), number(0.7, 1.0)));
        object.objectFromWorld = glm::affineInverse(worldFromObject);
        return object;
    }

    ClipSpec randomClip(const Grid& grid) {
        ClipSpec clip;
        if (coin())
            for (int i = whole(1, 4); i > 0; --i) {
                const auto normal = direction();
                clip.planes.push_back({normal, glm::dot(normal, centreWorld(grid)) -
                                                   boundingRadiusWorld(grid) * number(-0.2, 0.6)});
            }
        if (coin()) clip.object = randomObject(grid);
        return clip;
    }

    ShadingSpec randomShading() {
        ShadingSpec shading;
        shading.enabled = coin(0.6);
        shading.gradient = coin() ? GradientSource::Texture : GradientSource::OnTheFly;
        shading.headLight = number(0.0, 1.0);
        for (int i = whole(0, 3); i > 0; --i)
            shading.lightsView.push_back(direction());
        shading.specular = number(0.0, 0.4);
        return shading;
    }

    IsosurfaceSpec randomIsosurface(const Grid& grid, int trial) {
        IsosurfaceSpec isosurface;
        for (int i = whole(1, 3); i > 0; --i)
            isosurface.surfaces.push_back(
                {number(0.15, 0.8), glm::vec4(number(0.1, 1.0), number(0.1, 1.0), number(0.1, 1.0),
                                              coin() ? 1.0 : number(0.2, 0.9))});
        isosurface.caps = coin();
        if (coin(0.3)) {
            auto other = grid;
            other.dims = {9, 8, 10};
            other.worldFromIndex[0] *= grid.dims.x / 9.0;
            other.worldFromIndex[1] *= grid.dims.y / 11.0;
            other.worldFromIndex[2] *= grid.dims.z / 10.0;
            const auto key = "colours" + std::to_string(trial);
            add(fields::linearRamp(), other, ScalarType::F32, key);
            isosurface.colouredBy = ColourVolume{key, 0, 0, 0, fields::filledTable(0.05, 0.95)};
        }
        return isosurface;
    }

    /// Another field over a part of the box and what lies beside it.
    LayersSpec randomLayers(const Grid& grid, int trial) {
        LayersSpec layers;
        layers.ownWeight = number(0.2, 1.0);
        for (int i = whole(1, 3); i > 0; --i) {
            auto other = grid;
            other.dims = {whole(8, 20), whole(8, 20), whole(8, 20)};
            other.worldFromIndex[3] += glm::dvec4(0.3 * boundingRadiusWorld(grid) * direction(), 0.0);
            const auto field = fields::gaussianSum();
            const auto key = "layer" + std::to_string(trial) + "_" + std::to_string(i);
            add(field, other, coin() ? ScalarType::U8 : ScalarType::F32, key);
            VolumeLayer layer;
            layer.dataset = key;
            layer.transfer = fields::filledTable(field.low, field.high);
            layer.unitLengthWorld = boundingRadiusWorld(grid) * number(0.01, 0.2);
            layer.weight = number(0.2, 1.0);
            layers.volumes.push_back(layer);
        }
        return layers;
    }

    TileSpec randomTile(const Grid& grid, int trial) {
        const auto field = fields::gaussianSum();
        const auto key = "volume" + std::to_string(trial);
        constexpr ScalarType types[] = {ScalarType::U8, ScalarType::U16, ScalarType::F32};
        add(field, grid, types[whole(0, 2)], key);
        auto tile = fields::tileOf(key, grid, GetParam(), 1);
        tile.sizePixels = {whole(20, 60), whole(20, 60)};
        tile.level = coin(0.2) ? 1 : 0;
        tile.sampleDistanceVoxels = coin(0.2) ? number(0.6, 14.0) : number(0.2, 0.6);
        tile.transfer = coin() ? fields::filledTable(field.low, field.high)
                               : fields::sparseTable(field.low, 0.8 * field.high);
        tile.camera = randomCamera(grid);
        tile.clip = randomClip(grid);
        tile.shading = randomShading();
        if (GetParam() == Technique::Raycast && coin()) tile.layers = randomLayers(grid, trial);
        if (GetParam() == Technique::Isosurface) tile.isosurface = randomIsosurface(grid, trial);
        if (trial % 3 == 1) tile.classification = Classification::PreIntegrated;
        return tile;
    }

private:
    std::mt19937 random_{static_cast<unsigned>(GetParam()) + 7};
};

inline std::string describe(const TileSpec& tile, const Grid& grid) {
    std::ostringstream out;
    out << fields::nameOf(tile.technique) << " " << fields::nameOf(tile.camera.projection) << " dims "
        << grid.dims.x << "x" << grid.dims.y << "x" << grid.dims.z << " periodic " << grid.periodic.x
        << grid.periodic.y << grid.periodic.z << (grid.centring == Centring::Cell ? " cells" : "")
        << " level " << tile.level << " distance " << tile.sampleDistanceVoxels << " planes "
        << tile.clip.planes.size();
    if (tile.clip.object)
        out << " " << tile.clip.object->dataset
            << (tile.clip.object->mode == ClipMode::Probe ? " probe" : " clip")
            << (tile.clip.object->binary ? " binary" : "");
    if (tile.shading.enabled)
        out << (tile.shading.gradient == GradientSource::Texture ? " lit (texture)" : " lit (taps)");
    if (tile.technique == Technique::Isosurface)
        out << " surfaces " << tile.isosurface.surfaces.size() << (tile.isosurface.caps ? " caps" : "")
            << (tile.isosurface.colouredBy ? " coloured" : "");
    if (preIntegrates(tile)) out << " pre-integrated";
    if (!tile.layers.volumes.empty()) out << " layers " << tile.layers.volumes.size();
    return out.str();
}

/// Pixels that differ by more than `tolerance` in a channel, but for those in `left out`.
inline std::size_t pixelsApart(const fields::Picture& a, const fields::Picture& b, double tolerance,
                               const std::vector<bool>& leftOut = {}) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const auto d = glm::abs(a.pixels[i] - b.pixels[i]);
        const bool counts = leftOut.empty() || !leftOut[i];
        count += counts && std::max({d.x, d.y, d.z, d.w}) > tolerance ? 1U : 0U;
    }
    return count;
}

} // namespace voxsheet::image
