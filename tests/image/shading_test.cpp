// Phong shading of volumes, on every texture format, against the double-precision truth.
#include "image/inside_scene.h"

#include "base/errors.h"

#include <cmath>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 72;

struct Format {
    const char* name;
    ScalarType type;
    FloatTexels texels;
    double decibels; ///< that the picture must reach
};
// Half floats keep 11 bits of a value: gradients of neighbouring samples lose most of them.
constexpr Format kFormats[] = {{"u8", ScalarType::U8, FloatTexels::Full, 45.0},
                               {"u16", ScalarType::U16, FloatTexels::Full, 45.0},
                               {"f32", ScalarType::F32, FloatTexels::Full, 45.0},
                               {"half", ScalarType::F32, FloatTexels::Half, 38.0}};

class Shading : public InsideScene {
protected:
    TileSpec litTile(const Grid& grid, const fields::AnalyticField& field, const std::string& key) {
        auto tile = fields::tileOf(key, grid, Technique::Raycast, kPixels);
        tile.transfer = fields::filledTable(field.low, field.high);
        tile.shading.enabled = true;
        tile.shading.headLight = 0.4;
        tile.shading.lightsView = {glm::normalize(glm::dvec3(0.5, 0.8, 0.4)),
                                   glm::normalize(glm::dvec3(-1.0, 0.1, 0.3))};
        tile.shading.lightIntensity = 0.6;
        return tile;
    }
};

TEST_F(Shading, VolumesOfEveryFormat) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 36);
    for (const auto& format : kFormats) {
        add(field, grid, format.type, format.name);
        for (const auto technique : {Technique::Raycast, Technique::Slices})
            for (const auto projection : {Projection::Perspective, Projection::Orthographic})
                for (const auto gradient : {GradientSource::OnTheFly, GradientSource::Texture}) {
                    auto tile = litTile(grid, field, format.name);
                    tile.technique = technique;
                    tile.camera = fields::cameraOf(grid, projection);
                    tile.floatTexels = format.texels;
                    tile.shading.gradient = gradient;
                    std::printf("%s %s ", format.name,
                                gradient == GradientSource::Texture ? "texture" : "six taps");
                    (void)agree(tile, format.decibels);
                }
    }
}

TEST_F(Shading, AnisotropicShearedAndPeriodicGrids) {
    fields::AnalyticField waves = fields::gaussianSum();
    waves.value = [](const glm::dvec3& p) {
        return 0.5 + 0.15 * (std::sin(3.14159265358979 * p.x) + std::cos(3.14159265358979 * p.y) +
                             std::sin(3.14159265358979 * (p.z + 0.3)));
    };
    for (const auto geometry : {fields::Geometry::Anisotropic, fields::Geometry::Sheared})
        for (const bool periodic : {false, true}) {
            auto grid = fields::gridOf(geometry, 30);
            grid.periodic = glm::bvec3(periodic);
            const auto key = std::string(fields::nameOf(geometry)) + (periodic ? " periodic" : "");
            add(waves, grid, ScalarType::F32, key);
            for (const auto gradient : {GradientSource::OnTheFly, GradientSource::Texture}) {
                auto tile = litTile(grid, waves, key);
                tile.shading.gradient = gradient;
                (void)agree(tile);
            }
        }
}

// Here every sample lies within a voxel of an end, where differences are one-sided.
TEST_F(Shading, EndsOfSmallVolumes) {
    auto field = fields::gaussianSum();
    for (const auto dims : {glm::ivec3(2, 3, 4), glm::ivec3(3, 2, 3), glm::ivec3(4, 4, 2)})
        for (const auto centring : {Centring::Point, Centring::Cell}) {
            auto grid = fields::gridOf(fields::Geometry::Isotropic, 4);
            grid.dims = dims;
            grid.centring = centring;
            const auto key = std::to_string(dims.x) + std::to_string(dims.y) + std::to_string(dims.z) +
                             (centring == Centring::Cell ? " cells" : "");
            add(field, grid, ScalarType::F32, key);
            for (const auto gradient : {GradientSource::OnTheFly, GradientSource::Texture}) {
                auto tile = litTile(grid, field, key);
                tile.unitLengthWorld = 0.02; // dense enough to be seen
                tile.sampleDistanceVoxels = 0.1;
                tile.shading.gradient = gradient;
                (void)agree(tile);
            }
        }
}

TEST_F(Shading, TextureAndSixTapsGiveOnePicture) {
    const auto field = fields::marschnerLobb();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 40);
    add(field, grid, ScalarType::F32, "ml");
    auto tile = litTile(grid, field, "ml");
    const auto taps = painter.draw(tile);
    const auto resident = painter.residency().state().residentBytes;
    tile.shading.gradient = GradientSource::Texture;
    const auto texture = painter.draw(tile);
    // The gradient texture's 16-bit floats, and the outermost voxel, where the two are defined differently.
    EXPECT_GT(fields::difference(taps, texture).psnr, 45.0);
    // SIMD kernels take the same gradients from the samples.
    const auto gradientBytes = painter.context().workarounds().simdRays ? 0U : 8U * 40 * 40 * 40;
    EXPECT_EQ(painter.residency().state().residentBytes - resident, gradientBytes) << "its bytes are counted";
}

TEST_F(Shading, ALinearFieldHasOneNormalEverywhere) {
    // value = 0.5 + slope . p over a sheared grid: the gradient in the world is known.
    const glm::dvec3 slope(0.25, -0.1, 0.15);
    const auto field = fields::linearRamp(slope);
    const auto grid = fields::gridOf(fields::Geometry::Sheared, 20);
    add(field, grid, ScalarType::F32, "linear");
    const auto worldFromCube = worldFromTexture(grid); // texture = (p + 1) / 2: the same direction
    const auto normal = glm::normalize(glm::transpose(glm::inverse(glm::dmat3(worldFromCube))) * slope);
    auto tile = fields::tileOf("linear", grid, Technique::Raycast, 33);
    tile.camera = fields::cameraOf(grid, Projection::Orthographic);
    tile.camera.heightWorld *= 0.3; // all pixels inside the box
    TransferFunction white;
    white.colours = {{0.0, glm::dvec3(1.0)}};
    white.opacities = {{0.0, 0.9}};
    tile.transfer = buildTransferTable(white);
    tile.shading.enabled = true;
    tile.shading.ambient = 0.0;
    tile.shading.diffuse = 1.0;
    tile.shading.specular = 0.0;
    tile.shading.headLight = 0.0;
    const auto viewNormal = glm::dmat3(tile.camera.viewFromWorld) * normal;
    const auto towards = viewNormal.z < 0.0 ? -viewNormal : viewNormal;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 light(0.0);
        light[axis] = towards[axis] < 0.0 ? -1.0 : 1.0;
        tile.shading.lightsView = {light};
        const auto pixel = painter.draw(tile).at(16, 16);
        EXPECT_NEAR(pixel.x / pixel.w, std::abs(towards[axis]), painter.filtersExactly() ? 2e-4 : 1e-3)
            << "axis " << axis;
    }
}

TEST_F(Shading, LightsOutOfRangeAreRefused) {
    const auto field = fields::linearRamp();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 8);
    add(field, grid, ScalarType::U8, "refuse");
    const auto tile = litTile(grid, field, "refuse");
    const auto refusedField = [&](const ShadingSpec& shading) {
        auto spoiled = tile;
        spoiled.shading = shading;
        try {
            (void)painter.draw(spoiled);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("drawn");
    };
    auto shading = tile.shading;
    shading.lightsView = {glm::dvec3(0.0)};
    EXPECT_EQ(refusedField(shading), "light.direction");
    shading.lightsView = std::vector<glm::dvec3>(kMaxLights + 1, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(refusedField(shading), "light.direction");
    shading = tile.shading;
    shading.shininess = std::nan("");
    EXPECT_EQ(refusedField(shading), "shading.shininess");
    shading = tile.shading;
    shading.ambient = -0.1;
    EXPECT_EQ(refusedField(shading), "shading.ambient");
}

} // namespace
} // namespace voxsheet::image
