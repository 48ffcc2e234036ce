// Pre-integrated transfer functions: what they are defined as, and that they see what samples miss.
#include "image/inside_scene.h"

#include <cmath>
#include <limits>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 64;
constexpr int kSamples = 40;
constexpr double kConvergedVoxels = 1.0 / 32.0;

class PreIntegration : public InsideScene {
protected:
    TileSpec meanTile(const std::string& key, std::shared_ptr<const TransferTable> table) {
        auto tile = fields::tileOf(key, grid, Technique::Raycast, kPixels);
        tile.transfer = std::move(table);
        tile.classification = Classification::PreIntegrated;
        return tile;
    }

    double fromIntegral(TileSpec tile) {
        const auto picture = painter.draw(tile);
        tile.classification = Classification::AtSamples;
        tile.sampleDistanceVoxels = kConvergedVoxels;
        const auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.provider(), tile));
        const double psnr = fields::difference(picture, truth).psnr;
        std::printf("%.1f dB\n", psnr);
        return psnr;
    }

    Grid grid = fields::gridOf(fields::Geometry::Isotropic, kSamples);
    fields::AnalyticField field = fields::gaussianSum();
};

TEST_F(PreIntegration, SharpPeaksNeedNoShortSteps) {
    add(field, grid, ScalarType::F32, "f32");
    auto tile = meanTile("f32", fields::peaksTable(field.low, field.high));
    for (const double distance : {0.5, 1.0}) {
        tile.sampleDistanceVoxels = distance;
        tile.classification = Classification::AtSamples;
        const double sampled = fromIntegral(tile);
        tile.classification = Classification::PreIntegrated;
        EXPECT_GT(fromIntegral(tile), sampled + 10.0) << distance << " voxels";
    }
}

TEST_F(PreIntegration, IsTheMeanBetweenTheEndsOfStretches) {
    add(field, grid, ScalarType::U8, "u8");
    add(field, grid, ScalarType::F32, "f32");
    for (const char* key : {"u8", "f32"})
        for (const bool lit : {false, true})
            for (const double distance : {0.3, 0.8, 2.0}) {
                auto tile = meanTile(key, fields::peaksTable(field.low, field.high));
                tile.sampleDistanceVoxels = distance;
                tile.shading.enabled = lit;
                tile.clip.planes = {planeThrough(grid, glm::dvec3(0.45), {0.3, 1.0, -0.5})};
                (void)agree(tile);
            }
}

TEST_F(PreIntegration, OnLogarithmicScalesAndBeyondTheRange) {
    add(field, grid, ScalarType::F32, "f32");
    TransferFunction function;
    function.low = 0.2;
    function.high = 0.6;
    function.colours = {{0.0, {0.1, 0.2, 0.9}}, {1.0, {0.9, 0.8, 0.2}}};
    function.opacities = {{0.0, 0.02}, {0.5, 0.3}, {1.0, 0.02}};
    function.hasBelow = function.hasAbove = true;
    function.below = {1.0, 0.0, 0.0, 0.01};
    function.above = {0.0, 1.0, 0.0, 0.4};
    for (const auto scale : {ValueScale::Linear, ValueScale::Log, ValueScale::SymLog}) {
        function.scale = scale;
        auto tile = meanTile("f32", buildTransferTable(function));
        tile.sampleDistanceVoxels = 1.5;
        (void)agree(tile, 42.0); // the table's ends are rounded to an entry
    }
}

// Integrals up to thin matter here hold all of the opaque entries below it.
TEST_F(PreIntegration, OpaqueMatterLeavesThinMatterAsItIs) {
    add(field, grid, ScalarType::F32, "f32");
    TransferFunction function;
    function.low = -0.5 * field.high; // the field itself has no such values
    function.high = field.high;
    function.colours = {{0.0, {0.1, 0.2, 0.9}}, {1.0, {0.9, 0.8, 0.2}}};
    function.opacities = {{0.0, 1.0}, {0.3, 1.0}, {0.3, 0.002}, {1.0, 0.01}};
    (void)agree(meanTile("f32", buildTransferTable(function)), 50.0);
}

TEST_F(PreIntegration, AbsentSamplesStayAbsent) {
    auto holed = field;
    holed.value = [value = field.value](const glm::dvec3& p) {
        return p.x > 0.1 && p.y > -0.2 ? std::numeric_limits<double>::quiet_NaN() : value(p);
    };
    add(holed, grid, ScalarType::F32, "holes");
    (void)agree(meanTile("holes", fields::filledTable(field.low, field.high)));
}

} // namespace
} // namespace voxsheet::image
