// The truth for clipped, lit and isosurface pictures, on closed forms.
#include "fields/inside.h"
#include "fields/sampled_field.h"
#include "fields/scenes.h"
#include "volume/memory_volume_provider.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet::fields {
namespace {

class Inside : public testing::Test {
protected:
    Sources add(const AnalyticField& field, const Grid& grid, const std::string& key) {
        auto sampled = sampleField(field, grid, ScalarType::F32, key);
        provider.add(std::move(sampled.meta), std::move(sampled.arrays));
        tile = tileOf(key, grid, Technique::Raycast, 33);
        tile.transfer = filledTable(field.low, field.high);
        tile.camera = cameraOf(grid, Projection::Orthographic, 0.0, 0.0); // looks along -z
        return sourcesOf(provider, tile);
    }
    RayTruth centralRay(const Sources& sources) const { return {tile, sources, worldRay(tile, 16.5, 16.5)}; }

    MemoryVolumeProvider provider;
    TileSpec tile;
};

TEST_F(Inside, KeptRangesEndAtBoxAndPlanes) {
    const auto grid = gridOf(Geometry::Isotropic, 21); // a box of edge 20
    const auto sources = add(linearRamp(), grid, "ramp");
    const auto whole = centralRay(sources);
    EXPECT_NEAR(whole.range.end - whole.range.begin, 20.0, 1e-9);
    EXPECT_NEAR(glm::distance(whole.range.entryNormal, glm::dvec3(0, 0, 1)), 0.0, 1e-12);
    EXPECT_EQ(whole.range.cutPlane, -1);
    tile.clip.planes = {{{0, 0, -1}, -15.0}, {{0, 0, 1}, 3.0}};
    const auto cut = centralRay(sources);
    EXPECT_NEAR(cut.range.end - cut.range.begin, 12.0, 1e-9);
    EXPECT_EQ(cut.range.cutPlane, 0);
    EXPECT_NEAR(cut.ray.at(cut.range.begin).z, 15.0, 1e-9);
    tile.clip.planes = {{{1, 0, 0}, 100.0}};
    const auto nothing = centralRay(sources);
    EXPECT_LE(nothing.range.end, nothing.range.begin);
}

TEST_F(Inside, AUniformSlabHasTheKnownOpacity) {
    auto constant = linearRamp(glm::dvec3(0.0));
    constant.low = 0.0;
    constant.high = 1.0;
    const auto grid = gridOf(Geometry::Isotropic, 21);
    auto sources = add(constant, grid, "constant");
    TransferFunction function;
    function.colours = {{0.0, {0.25, 0.5, 1.0}}};
    function.opacities = {{0.0, 0.1}};
    tile.transfer = buildTransferTable(function);
    tile.clip.planes = {{{0, 0, -1}, -13.7}};
    for (const auto technique : {Technique::Raycast, Technique::Slices}) {
        tile.technique = technique;
        const auto pixel = insidePicture(tile, sources).at(16, 16);
        EXPECT_NEAR(pixel.w, 1.0 - std::pow(0.9, 13.7), 1e-7)
            << nameOf(technique); // tables are 32-bit floats
        EXPECT_NEAR(pixel.y, 0.5 * pixel.w, 1e-9);
    }
    // A ball of radius 6 about the centre keeps a path of 12 through its middle.
    AnalyticField ball = sphereDistance(0.6);
    auto sampled = sampleField(ball, gridOf(Geometry::Isotropic, 101), ScalarType::F32, "ball");
    provider.add(std::move(sampled.meta), std::move(sampled.arrays));
    tile.clip.planes.clear();
    ClipObject object;
    object.dataset = "ball";
    // Sample i of n of the ball's grid is the point (2 i + 1) / n - 1 of the unit cube: 6 world units are 0.6
    // there.
    const double scale = 101.0 / 20.0;
    object.objectFromWorld = glm::dmat4(scale);
    object.objectFromWorld[3] = glm::dvec4(glm::dvec3(50.0) - scale * glm::dvec3(10.0), 1.0);
    for (const auto mode : {ClipMode::Probe, ClipMode::Clip}) {
        object.mode = mode;
        tile.clip.object = object;
        const double path = mode == ClipMode::Probe ? 12.0 : 8.0;
        const auto clipped = sourcesOf(provider, tile);
        // The central pixel's ray passes the ball's middle; distances are sampled, so the path is a little
        // off.
        EXPECT_NEAR(insidePicture(tile, clipped).at(16, 16).w, 1.0 - std::pow(0.9, path), 2e-3);
    }
}

TEST_F(Inside, RootsOfALinearFieldAreExact) {
    const auto grid = gridOf(Geometry::Sheared, 17);
    auto sources = add(linearRamp({0.1, 0.2, 0.3}), grid, "ramp");
    tile.technique = Technique::Isosurface;
    tile.isosurface.surfaces = {{0.5, glm::vec4(1.0F)}, {0.45, glm::vec4(1.0F)}, {7.0, glm::vec4(1.0F)}};
    const auto ray = centralRay(sources);
    const auto hits = isoHits(ray);
    ASSERT_EQ(hits.size(), 2U) << "7 is out of range";
    for (const auto& hit : hits) {
        const double isovalue = tile.isosurface.surfaces[static_cast<std::size_t>(hit.surface)].value;
        EXPECT_NEAR(ray.value(hit.depth), isovalue, 1e-7);
    }
    EXPECT_LT(hits[0].depth, hits[1].depth);
}

TEST_F(Inside, TwoRootsWithinOneCellAreBothFound) {
    // A ridge between samples: along z the interpolant rises and falls within one cell of x and y only where
    // it is bilinear.
    AnalyticField saddle = linearRamp();
    saddle.low = -1.0;
    saddle.high = 1.0;
    saddle.value = [](const glm::dvec3& p) { return p.x * p.y; };
    const auto grid = gridOf(Geometry::Isotropic, 2);
    auto sources = add(saddle, grid, "saddle");
    tile.technique = Technique::Isosurface;
    tile.camera = cameraOf(grid, Projection::Orthographic, 0.0, 0.0);
    tile.isosurface.surfaces = {{0.2, glm::vec4(1.0F)}};
    // Along the diagonal of x and y the product is a parabola: v = t^2 / 4 with t from -1 to 1, 0.2 at two
    // places.
    WorldRay diagonal{{0.0, 0.0, 0.5}, {1.0, 1.0, 0.0}};
    tile.camera.projection = Projection::Perspective;
    const RayTruth ray(tile, sources, diagonal);
    const auto hits = isoHits(ray);
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_NEAR(hits[0].depth, 0.5 - 0.5 * std::sqrt(0.8), 1e-7);
    EXPECT_NEAR(hits[1].depth, 0.5 + 0.5 * std::sqrt(0.8), 1e-7);
}

TEST_F(Inside, LightFollowsTheFormula) {
    const auto grid = gridOf(Geometry::Isotropic, 9);
    const auto sources = add(linearRamp(), grid, "ramp");
    tile.shading.enabled = true;
    tile.shading.ambient = 0.2;
    tile.shading.diffuse = 0.5;
    tile.shading.specular = 0.3;
    tile.shading.shininess = 2.0;
    tile.shading.headLight = 1.0;
    const auto ray = centralRay(sources);
    const glm::dvec3 rgb(0.4, 0.6, 0.8);
    // Head light, normal at 60 degrees: N.L = 1/2, R.V = 2/4 - 1 < 0.
    const glm::dvec3 slanted(std::sqrt(0.75), 0.0, 0.5);
    EXPECT_NEAR(ray.lit(rgb, slanted).x, 0.4 * (0.2 + 0.5 * 0.5), 1e-12);
    EXPECT_NEAR(ray.lit(rgb, -7.0 * slanted).x, 0.4 * (0.2 + 0.5 * 0.5), 1e-12) << "any length, either side";
    EXPECT_NEAR(ray.lit(rgb, {0, 0, 1}).y, 0.6 * 0.7 + 0.3, 1e-12) << "straight: full highlight";
    EXPECT_EQ(ray.lit(rgb, glm::dvec3(0.0)), rgb) << "no gradient";
    tile.shading.headLight = 0.0;
    tile.shading.lightsView = {{1, 0, 0}};
    EXPECT_NEAR(ray.lit(rgb, slanted).z, 0.8 * (0.2 + 0.5 * std::sqrt(0.75)) + 0.3 * 0.75, 1e-12)
        << "R = 2 (N.L) N - L, R.V = sqrt(0.75)";
}

} // namespace
} // namespace voxsheet::fields
