// Isosurfaces coloured by another volume: matched in the world, with their own colour where it has none.
#include "image/isosurface_scene.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace voxsheet::image {
namespace {

class ColourVolumes : public IsosurfaceScene {
protected:
    ColourVolumes() { add(fields::sphereDistance(0.7), grid, ScalarType::F32, "ball"); }

    TileSpec colouredTile(const std::string& key, std::shared_ptr<const TransferTable> table) {
        auto tile = isoTile(grid, "ball", 0.0);
        tile.isosurface.colouredBy = ColourVolume{key, 0, 0, 0, std::move(table)};
        return tile;
    }
    /// Pixels of the picture with the surface's own colour, and others that show it.
    struct Count {
        std::size_t own = 0;
        std::size_t other = 0;
    };
    static Count countOf(const fields::Picture& picture, const glm::vec4& own) {
        Count count;
        for (const auto& pixel : picture.pixels) {
            if (pixel.w < 0.5) continue;
            const bool isOwn = glm::distance(glm::dvec3(pixel), glm::dvec3(own)) < 1e-4;
            (isOwn ? count.own : count.other) += 1U;
        }
        return count;
    }

    Grid grid = fields::gridOf(fields::Geometry::Isotropic, 32);
};

TEST_F(ColourVolumes, OfEveryKindAgreeWithTheTruth) {
    const auto field = fields::marschnerLobb();
    for (const auto geometry : {fields::Geometry::Anisotropic, fields::Geometry::Sheared})
        for (const auto type : {ScalarType::U8, ScalarType::U16, ScalarType::F32})
            for (const bool periodic : {false, true}) {
                // Another grid in the same world, that reaches over a part of the surface.
                auto other = fields::gridOf(geometry, 25);
                const auto shift = centreWorld(grid) - centreWorld(other) + glm::dvec3(4.0, 3.0, 2.0);
                other.worldFromIndex[3] += glm::dvec4(shift, 0.0);
                other.periodic = glm::bvec3(periodic);
                const auto key =
                    std::string(fields::nameOf(geometry)) + scalarName(type) + (periodic ? "p" : "");
                add(field, other, type, key);
                auto tile = colouredTile(key, fields::filledTable(field.low, field.high));
                const auto count = countOf(agreeInside(tile, grid), tile.isosurface.surfaces[0].colour);
                EXPECT_GT(count.other, 300U) << key;
                EXPECT_GT(count.own, 20U) << key << ": nothing lies outside it";
                tile.shading.enabled = true;
                tile.isosurface.colouredBy->level = 1;
                (void)agreeInside(tile, grid);
            }
}

TEST_F(ColourVolumes, LogarithmicTablesAndValuesBeyondThem) {
    auto field = fields::gaussianSum();
    const auto base = field.value;
    field.value = [base](const glm::dvec3& p) { return 1e-4 * std::pow(10.0, 4.0 * base(p)); };
    add(field, grid, ScalarType::F32, "decades");
    TransferFunction function;
    function.scale = ValueScale::Log;
    function.low = 1e-4;
    function.high = 1e-2;
    function.colours = {{0.0, {0.1, 0.2, 0.9}}, {1.0, {0.9, 0.8, 0.1}}};
    function.opacities = {{0.0, 0.0}};
    function.hasAbove = true;
    function.above = {1.0, 0.0, 0.0, 1.0};
    const auto tile = colouredTile("decades", buildTransferTable(function));
    const auto picture = agreeInside(tile, grid);
    EXPECT_GT(countOf(picture, {1.0F, 0.0F, 0.0F, 1.0F}).own, 30U)
        << "values above the range have their colour";
}

TEST_F(ColourVolumes, WithoutAValueKeepTheSurfacesOwn) {
    auto sampled = fields::sampleField(fields::linearRamp(), grid, ScalarType::F32, "holes");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < sampled.arrays[0].size() / sizeof(float) / 2; ++i)
        std::memcpy(sampled.arrays[0].data() + i * sizeof(float), &nan, sizeof nan);
    add(std::move(sampled));
    auto tile = colouredTile("holes", fields::filledTable(0.05, 0.95));
    const auto count = countOf(agreeInside(tile, grid), tile.isosurface.surfaces[0].colour);
    EXPECT_GT(count.own, 100U);
    EXPECT_GT(count.other, 300U);
}

TEST_F(ColourVolumes, TheShaderCanFilterThemForItself) {
    add(fields::marschnerLobb(), grid, ScalarType::F32, "colours");
    const auto tile = colouredTile("colours", fields::filledTable(0.0, 1.0));
    const auto filtered = painter.draw(tile);
    painter.techniques().setShaderFiltering(true);
    const auto own = painter.draw(tile);
    EXPECT_GT(fields::difference(filtered, own).psnr, 60.0);
    EXPECT_GT(fields::difference(filtered, own).pixels, 1000U);
}

} // namespace
} // namespace voxsheet::image
