// A plane through a volume shows the interpolant, or the samples, where it cuts the box.
#include "base/errors.h"
#include "image/inside_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 96;

/// Red rises from 0 to 1 with the value over the range, in more steps than any tolerance here.
std::shared_ptr<const TransferTable> ramp(double low, double high) {
    TransferFunction function;
    function.colours = {{0.0, {0.0, 0.5, 1.0}}, {1.0, {1.0, 0.5, 0.0}}};
    function.low = low;
    function.high = high;
    function.opacities = {{0.0, 0.02}}; // Which planes do not heed.
    function.nan = {0.2, 0.6, 0.4, 0.5};
    return buildTransferTable(function);
}

/// Faces the plane from where its normal points; the grid's box fills most of the picture.
CameraSpec facing(const glm::dvec3& normal, const Grid& grid) {
    CameraSpec camera;
    const auto centre = centreWorld(grid);
    const double radius = boundingRadiusWorld(grid);
    const glm::dvec3 up = std::abs(normal.z) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    camera.viewFromWorld = glm::lookAt(centre + 3.0 * radius * normal, centre, up);
    camera.projection = Projection::Orthographic;
    camera.heightWorld = 1.8 * radius;
    return camera;
}

TileSpec planeTile(const std::string& key, const Grid& grid, const glm::dvec3& normal,
                   const glm::dvec3& through = glm::dvec3(0.437, 0.561, 0.383)) {
    auto tile = fields::tileOf(key, grid, Technique::Plane, kPixels);
    const auto cut = planeThrough(grid, through, normal);
    tile.plane.normal = cut.normal;
    tile.plane.offset = cut.offset;
    tile.camera = facing(cut.normal, grid);
    tile.sizePixels = {kPixels + 13, kPixels};
    return tile;
}

class PlaneCuts : public InsideScene,
                  public testing::WithParamInterface<std::tuple<fields::Geometry, ScalarType>> {};

TEST_P(PlaneCuts, ShowTheInterpolantAndTheSamples) {
    const auto [geometry, type] = GetParam();
    const auto field = fields::gaussianSum();
    const Grid grid = fields::gridOf(geometry, 21);
    add(field, grid, type, "field");
    for (const glm::dvec3 normal : {glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0),
                                    glm::dvec3(0.5, -0.7, 0.6), glm::dvec3(-0.2, 0.1, -1.0)})
        for (const auto interpolation : {PlaneInterpolation::Linear, PlaneInterpolation::Nearest}) {
            auto tile = planeTile("field", grid, normal);
            tile.transfer = ramp(field.low, field.high);
            tile.plane.interpolation = interpolation;
            const auto picture = painter.draw(tile);
            const auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.provider(), tile));
            int inside = 0;
            int apart = 0;
            for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
                const auto& pixel = picture.pixels[i];
                if (truth.pixels[i].w > 0.0) ++inside;
                // Texture units of llvmpipe and GPUs weigh in steps of 1/256 of a voxel; neighbours here
                // differ by less than a quarter of the range on each of three axes.
                const double tolerance = interpolation == PlaneInterpolation::Linear ? 3.0 / 256 / 4 : 1e-3;
                const auto error = glm::abs(pixel - truth.pixels[i]);
                if (std::max({error.x, error.y, error.z, error.w}) > tolerance) ++apart;
                ASSERT_TRUE(pixel.w == 0.0 || pixel.w == 1.0) << "planes are opaque";
            }
            EXPECT_GT(inside, kPixels * kPixels / 10);
            // A pixel whose centre lies on an edge of a voxel or the box may fall to either side.
            EXPECT_LE(apart, inside / 1000)
                << "normal " << normal.x << ", " << normal.y << ", " << normal.z << " of " << inside
                << (interpolation == PlaneInterpolation::Nearest ? " nearest" : " linear");
        }
}

INSTANTIATE_TEST_SUITE_P(All, PlaneCuts,
                         testing::Combine(testing::Values(fields::Geometry::Isotropic,
                                                          fields::Geometry::Anisotropic,
                                                          fields::Geometry::Sheared),
                                          testing::Values(ScalarType::U8, ScalarType::I8, ScalarType::U16,
                                                          ScalarType::I16, ScalarType::F32)));

class PlaneCases : public InsideScene {};

TEST_F(PlaneCases, APlaneHalfWayBetweenSamplesDoesNotSpeckle) {
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 20);
    auto stripes = fields::linearRamp(glm::dvec3(0.0));
    stripes.low = 0.0;
    stripes.high = 1.0;
    stripes.value = [](const glm::dvec3& p) { return p.z > 0.0 ? 1.0 : 0.0; };
    add(stripes, grid, ScalarType::F32, "halves");
    auto tile = planeTile("halves", grid, {0, 0, 1}, glm::dvec3(0.5));
    tile.transfer = ramp(0.0, 1.0);
    tile.plane.interpolation = PlaneInterpolation::Nearest;
    int seen = 0;
    for (const auto& pixel : painter.draw(tile).pixels) {
        if (pixel.w == 0.0) continue;
        ++seen;
        EXPECT_EQ(pixel.x, 1.0) << "the sample of higher index";
    }
    EXPECT_GT(seen, 1000);
}

TEST_F(PlaneCases, PlanesInTheFacesOfTheBoxAreSeen) {
    const Grid grid = fields::gridOf(fields::Geometry::Sheared, 17);
    add(fields::gaussianSum(), grid, ScalarType::F32, "field");
    const glm::dmat3 edges(grid.worldFromIndex);
    for (const double end : {0.0, 1.0}) {
        auto tile = planeTile("field", grid, glm::cross(edges[0], edges[1]), glm::dvec3(0.5, 0.5, end));
        tile.transfer = ramp(0.0, 1.0);
        static_cast<void>(agree(tile, 45.0, 800));
    }
}

TEST_F(PlaneCases, HalfFloatsOtherLevelsAndPeriodicAxesToo) {
    const auto field = fields::gaussianSum();
    Grid grid = fields::gridOf(fields::Geometry::Anisotropic, 40);
    grid.periodic = {false, true, true};
    add(field, grid, ScalarType::F32, "field");
    for (const int level : {0, 1})
        for (const auto format : {FloatTexels::Full, FloatTexels::Half})
            for (const bool inShader : {false, true}) {
                auto tile = planeTile("field", grid, {0.3, 0.2, 1});
                tile.transfer = ramp(field.low, field.high);
                tile.level = level;
                tile.floatTexels = format;
                painter.techniques().setShaderFiltering(inShader);
                static_cast<void>(agree(tile, 45.0, 1000));
            }
}

TEST_F(PlaneCases, SamplesWithoutAValueTakeTheirOwnColour) {
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 20);
    auto field = fields::gaussianSum();
    const auto value = field.value;
    field.value = [value](const glm::dvec3& p) {
        return p.x > 0.2 ? std::numeric_limits<double>::quiet_NaN() : value(p);
    };
    add(field, grid, ScalarType::F32, "gaps");
    auto tile = planeTile("gaps", grid, {0, 0, 1});
    tile.transfer = ramp(field.low, field.high);
    for (const auto interpolation : {PlaneInterpolation::Linear, PlaneInterpolation::Nearest}) {
        tile.plane.interpolation = interpolation;
        const auto picture = agree(tile, 45.0, 1000);
        const glm::dvec4 gap(0.1, 0.3, 0.2, 0.5);
        EXPECT_GT(std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                [&](const glm::dvec4& pixel) { return glm::distance(pixel, gap) < 1e-6; }),
                  500);
    }
}

TEST_F(PlaneCases, ClippingAndShadingDoNothingToThem) {
    const auto field = fields::gaussianSum();
    const Grid grid = fields::gridOf(fields::Geometry::Anisotropic, 20);
    add(field, grid, ScalarType::U8, "field");
    auto tile = planeTile("field", grid, {0.3, 0.2, 1});
    tile.transfer = ramp(field.low, field.high);
    const auto plain = painter.draw(tile);
    tile.clip.planes = {planeThrough(grid, glm::dvec3(0.5), {1, 0, 0})};
    tile.clip.object = ClipObject{clipShapeMeta(ClipShape::Sphere).key,
                                  glm::scale(glm::dmat4(1.0), glm::dvec3(0.1)), ClipMode::Clip, false};
    tile.shading.enabled = true;
    EXPECT_EQ(painter.draw(tile).pixels, plain.pixels);
}

TEST_F(PlaneCases, SeenEdgeOnThereIsNothingAndPerspectiveIsRefused) {
    const auto field = fields::gaussianSum();
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 20);
    add(field, grid, ScalarType::U8, "field");
    auto tile = planeTile("field", grid, {0, 0, 1});
    tile.transfer = ramp(field.low, field.high);
    tile.camera = facing({1, 0, 0}, grid);
    for (const auto& pixel : painter.draw(tile).pixels)
        ASSERT_EQ(pixel, glm::dvec4(0.0));
    tile.camera.projection = Projection::Perspective;
    EXPECT_THROW(painter.draw(tile), InvalidInput);
    tile = planeTile("field", grid, {0, 0, 1});
    tile.transfer = ramp(field.low, field.high);
    tile.plane.normal = {0, 0, 2};
    EXPECT_THROW(painter.draw(tile), InvalidInput);
}

} // namespace
} // namespace voxsheet::image
