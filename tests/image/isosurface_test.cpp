// Isosurfaces against the double-precision roots of the trilinear interpolant.
#include "fields/hit_map.h"
#include "image/inside_scene.h"

#include "base/errors.h"

#include <cmath>
#include <limits>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 96;

using fields::PixelHits;
using fields::silhouettes;

class IsosurfaceTruth : public InsideScene {
protected:
    TileSpec isoTile(const Grid& grid, const std::string& key, double value) {
        auto tile = fields::tileOf(key, grid, Technique::Isosurface, kPixels);
        tile.transfer = fields::filledTable(-1.0, 1.0);
        tile.isosurface.surfaces = {{value, glm::vec4(0.9F, 0.6F, 0.3F, 1.0F)}};
        return tile;
    }

    PixelHits hitsOf(const TileSpec& tile) {
        return fields::isosurfaceHits(tile, fields::sourcesOf(painter.volumes(), tile));
    }

    /// As agree(), but for pixels at silhouettes.
    fields::Picture agreeInside(const TileSpec& tile, const Grid& grid, double leastDecibels = 45.0,
                                std::size_t leastPixels = 300) {
        const auto silhouette = silhouettes(hitsOf(tile), tile.sizePixels, 3.0 * meanVoxelEdgeWorld(grid));
        auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.volumes(), tile));
        auto picture = painter.draw(tile);
        const auto whole = picture;
        for (std::size_t i = 0; i < silhouette.size(); ++i)
            if (silhouette[i]) truth.pixels[i] = picture.pixels[i] = glm::dvec4(0.0);
        const auto same = fields::difference(picture, truth);
        std::printf("isosurface  %6.1f dB (largest %.1e) %zu pixels\n", same.psnr, same.largest, same.pixels);
        EXPECT_GE(same.psnr, leastDecibels);
        EXPECT_GE(same.psnrAlpha, leastDecibels);
        EXPECT_GE(same.pixels, leastPixels);
        return whole;
    }

    /// Hits where the reference has them and nowhere else, but at silhouettes.
    static void sameMask(const PixelHits& hits, const std::vector<bool>& silhouette,
                         const fields::Picture& picture) {
        std::size_t covered = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (silhouette[i]) continue;
            const bool hit = picture.pixels[i].w > 0.5;
            covered += hit ? 1U : 0U;
            wrong += hit == hits[i].empty() ? 1U : 0U;
        }
        EXPECT_EQ(wrong, 0U);
        EXPECT_GT(covered, 300U);
    }

    /// The largest distance of what the picture shows from the reference's first hits, in voxels: three
    /// pictures, coloured by volumes that hold x, y and z of the world.
    double worstPositionVoxels(TileSpec tile, const Grid& grid, const PixelHits& hits,
                               const std::vector<bool>& silhouette) {
        const double reach = kReachRadii * boundingRadiusWorld(grid);
        const auto centre = centreWorld(grid);
        Grid around;
        around.dims = glm::ivec3(2);
        around.worldFromIndex = glm::dmat4(2.0 * reach);
        around.worldFromIndex[3] = glm::dvec4(centre - reach, 1.0);
        tile.shading.enabled = false;
        std::vector<glm::dvec3> seen(hits.size());
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 slope(0.0);
            slope[axis] = 0.5;
            const auto key = "position" + std::to_string(axis) + tile.dataset;
            // Over the cube of texture coordinates the two samples sit at +-1/2.
            add(fields::linearRamp(slope), around, ScalarType::F32, key);
            TransferFunction ramp;
            ramp.colours = {{0.0, glm::dvec3(0.0)}, {1.0, glm::dvec3(1.0)}};
            ramp.opacities = {{0.0, 1.0}};
            ramp.low = 0.25;
            ramp.high = 0.75;
            tile.isosurface.colouredBy = ColourVolume{key, 0, 0, 0, buildTransferTable(ramp, kPositionSteps)};
            const auto picture = painter.draw(tile);
            for (std::size_t i = 0; i < seen.size(); ++i)
                seen[i][axis] = centre[axis] + (2.0 * picture.pixels[i].x - 1.0) * reach;
        }
        double worst = 0.0;
        for (int y = 0; y < tile.sizePixels.y; ++y)
            for (int x = 0; x < tile.sizePixels.x; ++x) {
                const auto i = static_cast<std::size_t>(y * tile.sizePixels.x + x);
                if (silhouette[i] || hits[i].empty()) continue;
                const auto root = fields::worldRay(tile, x + 0.5, y + 0.5).at(hits[i].front().depth);
                worst = std::max(worst, glm::distance(seen[i], root));
            }
        return worst / meanVoxelEdgeWorld(grid);
    }

    static constexpr double kReachRadii = 1.05;
    static constexpr int kPositionSteps = 1 << 13;
    /// What the colour that carries a position can be off by: half a step of the table on each axis.
    static double carriedVoxels(const Grid& grid) {
        return 0.5 * std::sqrt(3.0) * 2.0 * kReachRadii * boundingRadiusWorld(grid) / (kPositionSteps - 1) /
               meanVoxelEdgeWorld(grid);
    }
};

TEST_F(IsosurfaceTruth, HitsAreTheRootsWithNoHolesOnEveryFormat) {
    struct Format {
        const char* name;
        ScalarType type;
        FloatTexels texels;
    };
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 40);
    for (const auto& field : {fields::torusDistance(), fields::sphereDistance(0.7), fields::marschnerLobb()})
        for (const auto& format : {Format{"u8", ScalarType::U8, FloatTexels::Full},
                                   Format{"u16", ScalarType::U16, FloatTexels::Full},
                                   Format{"f32", ScalarType::F32, FloatTexels::Full},
                                   Format{"half", ScalarType::F32, FloatTexels::Half}}) {
            const auto key = field.name + format.name;
            add(field, grid, format.type, key);
            auto tile = isoTile(grid, key, field.name == "Marschner-Lobb" ? 0.5 : 0.013);
            tile.floatTexels = format.texels;
            const auto hits = hitsOf(tile);
            const auto silhouette = silhouettes(hits, tile.sizePixels, 4.0);
            sameMask(hits, silhouette, painter.draw(tile));
            const double worst = worstPositionVoxels(tile, grid, hits, silhouette);
            std::printf("%-28s farthest hit from its root: %.4f voxel\n", key.c_str(), worst);
            // Half floats hold the torus's distances to 2^-12 of their range, which is 0.01 voxel and more
            // where it is flat.
            EXPECT_LE(worst, (format.texels == FloatTexels::Half ? 0.05 : 0.01) + carriedVoxels(grid)) << key;
        }
}

TEST_F(IsosurfaceTruth, PicturesAgreeOnEveryGridAndProjection) {
    for (const auto geometry :
         {fields::Geometry::Isotropic, fields::Geometry::Anisotropic, fields::Geometry::Sheared})
        for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
            const auto field = fields::gaussianSum();
            const auto grid = fields::gridOf(geometry, 36);
            const auto key = std::string(fields::nameOf(geometry)) + fields::nameOf(projection);
            add(field, grid, ScalarType::U16, key);
            auto tile = isoTile(grid, key, 0.35);
            tile.camera = fields::cameraOf(grid, projection);
            tile.shading.enabled = true;
            tile.shading.lightsView = {glm::normalize(glm::dvec3(0.4, 0.8, 0.5))};
            for (const auto gradient : {GradientSource::OnTheFly, GradientSource::Texture}) {
                tile.shading.gradient = gradient;
                (void)agreeInside(tile, grid);
            }
            tile.isosurface.surfaces = {{0.2, {0.2F, 0.5F, 0.9F, 0.3F}},
                                        {0.5, {0.9F, 0.4F, 0.2F, 0.6F}},
                                        {0.8, {1.0F, 1.0F, 0.2F, 1.0F}}};
            (void)agreeInside(tile, grid);
        }
}

TEST_F(IsosurfaceTruth, ClippedAndCapped) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Anisotropic, 36);
    add(field, grid, ScalarType::F32, "caps");
    addBall("ball");
    auto tile = isoTile(grid, "caps", 0.3);
    tile.shading.enabled = true;
    const auto whole = painter.draw(tile);
    tile.clip.planes = {planeThrough(grid, {0.35, 0.5, 0.7}, {-0.5, 0.1, -1.0})};
    const auto open = agreeInside(tile, grid, 45.0, 150);
    EXPECT_LT(fields::difference(whole, open).psnr, 40.0);
    tile.isosurface.caps = true;
    const auto closed = agreeInside(tile, grid, 45.0, 150);
    EXPECT_LT(fields::difference(open, closed).psnr, 40.0) << "no cap is seen";
    ClipObject object;
    object.dataset = "ball";
    object.objectFromWorld = objectOver(fields::gridOf(fields::Geometry::Isotropic, 48), grid, 0.6);
    tile.clip.object = object;
    tile.clip.planes.clear();
    for (const auto mode : {ClipMode::Probe, ClipMode::Clip}) {
        tile.clip.object->mode = mode;
        (void)agreeInside(tile, grid, 45.0, 150);
    }
}

TEST_F(IsosurfaceTruth, BothSignsOfSignedData) {
    fields::AnalyticField wave = fields::gaussianSum();
    wave.name = "dipole";
    wave.low = -1.0;
    wave.high = 1.0;
    wave.value = [](const glm::dvec3& p) { return 3.0 * p.x * std::exp(-4.0 * glm::dot(p, p)); };
    auto grid = fields::gridOf(fields::Geometry::Sheared, 32);
    grid.periodic = glm::bvec3(true);
    add(wave, grid, ScalarType::F32, "dipole");
    auto tile = isoTile(grid, "dipole", 0.25);
    tile.isosurface.surfaces.push_back({-0.25, {0.2F, 0.3F, 0.9F, 1.0F}});
    tile.shading.enabled = true;
    const auto picture = agreeInside(tile, grid);
    std::size_t red = 0;
    std::size_t blue = 0;
    for (const auto& pixel : picture.pixels) {
        red += pixel.x > pixel.z + 0.1 ? 1U : 0U;
        blue += pixel.z > pixel.x + 0.1 ? 1U : 0U;
    }
    EXPECT_GT(red, 100U);
    EXPECT_GT(blue, 100U);
}

TEST_F(IsosurfaceTruth, ThePlainTestLeavesGapsAndTheRefinedOneNone) {
    // Few samples over a steep field: from one to the next the value changes by more than the test's
    // tolerance.
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 20);
    add(fields::sphereDistance(0.7), grid, ScalarType::U8, "ball");
    auto tile = isoTile(grid, "ball", 0.0);
    const auto hits = hitsOf(tile);
    const auto silhouette = silhouettes(hits, tile.sizePixels, 4.0);
    const auto holes = [&](const fields::Picture& picture) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < hits.size(); ++i)
            count += !silhouette[i] && !hits[i].empty() && picture.pixels[i].w < 0.5 ? 1U : 0U;
        return count;
    };
    EXPECT_EQ(holes(painter.draw(tile)), 0U);
    tile.isosurface.method = IsosurfaceMethod::AlphaTest;
    const auto gaps = holes(painter.draw(tile));
    std::printf("the plain test leaves %zu of %zu pixels open\n", gaps, hits.size());
    EXPECT_GT(gaps, 100U);
}

TEST_F(IsosurfaceTruth, TheShaderCanFilterForItself) {
    for (const bool periodic : {false, true}) {
        auto grid = fields::gridOf(fields::Geometry::Sheared, 32);
        grid.periodic = glm::bvec3(periodic);
        const std::string key = periodic ? "wraps" : "clamps";
        add(fields::gaussianSum(), grid, ScalarType::F32, key);
        addBall("ball" + key);
        for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Mip,
                                     Technique::Surface, Technique::Isosurface}) {
            auto tile = isoTile(grid, key, 0.3);
            tile.technique = technique;
            tile.transfer = fields::filledTable(0.0, 1.1);
            tile.shading.enabled = true;
            ClipObject object;
            object.dataset = "ball" + key;
            object.objectFromWorld = objectOver(fields::gridOf(fields::Geometry::Isotropic, 48), grid, 0.8);
            tile.clip.object = object;
            const auto filtered = painter.draw(tile);
            painter.techniques().setShaderFiltering(true);
            const auto own = painter.draw(tile);
            painter.techniques().setShaderFiltering(false);
            // Both interpolate in 32-bit floats; they round differently.
            EXPECT_GT(fields::difference(filtered, own).psnr, 60.0) << fields::nameOf(technique);
        }
    }
}

TEST_F(IsosurfaceTruth, NothingToShowIsTransparent) {
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 24);
    add(fields::sphereDistance(0.7), grid, ScalarType::F32, "ball");
    auto tile = isoTile(grid, "ball", 100.0);
    const auto isTransparent = [&] {
        const auto picture = painter.draw(tile);
        return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                           [](const glm::dvec4& pixel) { return pixel == glm::dvec4(0.0); });
    };
    EXPECT_TRUE(isTransparent()) << "above the range";
    tile.isosurface.surfaces[0].value = -1e30;
    EXPECT_TRUE(isTransparent()) << "below the range";
    tile.isosurface.surfaces.clear();
    EXPECT_TRUE(isTransparent()) << "no isovalue";
    tile.isosurface.caps = true;
    tile.clip.planes = {planeThrough(grid, glm::dvec3(0.5), {0.0, 0.0, -1.0})};
    EXPECT_TRUE(isTransparent()) << "nothing to cap";
    tile.isosurface.surfaces = {{std::numeric_limits<double>::quiet_NaN(), glm::vec4(1.0F)}};
    EXPECT_THROW((void)painter.draw(tile), InvalidInput);
    tile.isosurface.surfaces.assign(kMaxIsosurfaces + 1, {0.0, glm::vec4(1.0F)});
    EXPECT_THROW((void)painter.draw(tile), InvalidInput);
}

} // namespace
} // namespace voxsheet::image
