// Tiles with everything drawn by lot: grids, cameras, cuts, lights, surfaces. Each must agree with the truth,
// and must not change when empty space is not skipped or the shader filters for itself.
#include "fields/hit_map.h"
#include "image/inside_scene.h"

#include "volume/clip_shapes.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <random>
#include <sstream>

namespace voxsheet::image {
namespace {

constexpr int kTiles = 10; ///< per technique; 150 were drawn once

/// Pixels that a 32-bit float may decide differently: edges of faces and of voxels of binary objects, samples
/// just within a voxel of a cut.
constexpr double kUndecided = 0.006;

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
        if (GetParam() == Technique::Isosurface) tile.isosurface = randomIsosurface(grid, trial);
        return tile;
    }

private:
    std::mt19937 random_{static_cast<unsigned>(GetParam()) + 7};
};

std::string describe(const TileSpec& tile, const Grid& grid) {
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
    return out.str();
}

/// Pixels that differ by more than `tolerance` in a channel, but for those in `left out`.
std::size_t pixelsApart(const fields::Picture& a, const fields::Picture& b, double tolerance,
                        const std::vector<bool>& leftOut = {}) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const auto d = glm::abs(a.pixels[i] - b.pixels[i]);
        const bool counts = leftOut.empty() || !leftOut[i];
        count += counts && std::max({d.x, d.y, d.z, d.w}) > tolerance ? 1U : 0U;
    }
    return count;
}

/// Pixels in which two neighbouring surfaces or edges meet, or where one surface is crossed twice within a
/// step.
std::vector<bool> undecidedPixels(const TileSpec& tile, const Grid& grid, const fields::Sources& sources) {
    const double jump = 3.0 * meanVoxelEdgeWorld(grid);
    if (tile.technique == Technique::Surface)
        return fields::silhouettes(fields::faceHits(tile, sources), tile.sizePixels, jump);
    if (tile.technique != Technique::Isosurface) return {};
    const auto hits = fields::isosurfaceHits(tile, sources);
    auto undecided = fields::silhouettes(hits, tile.sizePixels, jump);
    for (std::size_t pixel = 0; pixel < hits.size(); ++pixel) {
        const auto x = static_cast<double>(pixel % static_cast<std::size_t>(tile.sizePixels.x));
        const auto y = static_cast<double>(pixel / static_cast<std::size_t>(tile.sizePixels.x));
        const fields::RayTruth ray(tile, sources, fields::worldRay(tile, x + 0.5, y + 0.5));
        const double step = tile.sampleDistanceVoxels / ray.voxelsPerDepth;
        for (std::size_t i = 1; i < hits[pixel].size(); ++i)
            if (hits[pixel][i].depth - hits[pixel][i - 1].depth < step) undecided[pixel] = true;
    }
    return undecided;
}

TEST_P(RandomTiles, AgreeWithTheTruthAndWithThemselves) {
    for (int trial = 0; trial < kTiles; ++trial) {
        const auto grid = randomGrid();
        const auto tile = randomTile(grid, trial);
        const auto name = std::to_string(trial) + " " + describe(tile, grid);
        SCOPED_TRACE(name);
        const auto picture = painter.draw(tile);
        painter.techniques().setEmptySpaceSkipping(false);
        const auto inEverySpace = painter.draw(tile);
        if (painter.filtersExactly())
            EXPECT_TRUE(picture.pixels == inEverySpace.pixels) << "skipping empty space changes the picture";
        else
            EXPECT_EQ(pixelsApart(picture, inEverySpace, 1e-4), 0U)
                << "skipping empty space changes the picture";
        painter.techniques().setEmptySpaceSkipping(true);
        painter.techniques().setShaderFiltering(true);
        const std::size_t mayDiffer = painter.filtersExactly() ? 0 : picture.pixels.size() / 50;
        EXPECT_LE(pixelsApart(picture, painter.draw(tile), 1e-3), mayDiffer)
            << "the shader filters differently";
        painter.techniques().setShaderFiltering(false);
        // Long steps miss surfaces that they pass twice, wherever these are.
        if (GetParam() == Technique::Isosurface && tile.sampleDistanceVoxels > 0.6) continue;
        const auto sources = fields::sourcesOf(painter.provider(), tile);
        const auto apart = pixelsApart(picture, fields::insidePicture(tile, sources), 0.01,
                                       undecidedPixels(tile, grid, sources));
        std::printf("%3zu of %4zu pixels apart: %s\n", apart, picture.pixels.size(), name.c_str());
        EXPECT_LE(static_cast<double>(apart), 2.0 + kUndecided * static_cast<double>(picture.pixels.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(All, RandomTiles,
                         testing::Values(Technique::Raycast, Technique::Slices, Technique::Mip,
                                         Technique::Surface, Technique::Isosurface),
                         [](const testing::TestParamInfo<Technique>& tile) {
                             return fields::nameOf(tile.param);
                         });

} // namespace
} // namespace voxsheet::image
