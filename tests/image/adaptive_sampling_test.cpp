// Adaptive sampling: as close to the integral as even samples are, or close enough; where it does not apply,
// or ranges do not tell enough, the same picture as without.
#include "image/inside_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 64;
constexpr int kSamples = 64;
constexpr double kConvergedVoxels = 1.0 / 16.0;
constexpr double kGoodDecibels = 42.0;  ///< 40 is what users get promised
constexpr double kSameDecibels = 120.0; ///< positions are rounded another way

class AdaptiveSampling : public InsideScene {
protected:
    TileSpec tileOf(const std::string& key, std::shared_ptr<const TransferTable> table, bool lit) {
        auto tile = fields::tileOf(key, grid, Technique::Raycast, kPixels);
        tile.transfer = std::move(table);
        tile.unitLengthWorld = kSamples / 256.0;
        tile.shading.enabled = lit;
        return tile;
    }

    struct Pictures {
        fields::Picture even, adaptive;
    };
    Pictures draw(TileSpec tile) {
        Pictures pictures;
        tile.adaptiveSampling = false;
        pictures.even = painter.draw(tile);
        tile.adaptiveSampling = true;
        pictures.adaptive = painter.draw(tile);
        return pictures;
    }

    void expectGood(const TileSpec& tile) {
        auto fine = tile;
        fine.sampleDistanceVoxels = kConvergedVoxels;
        const auto truth = fields::insidePicture(fine, fields::sourcesOf(painter.provider(), fine));
        const auto pictures = draw(tile);
        const double even = fields::difference(pictures.even, truth).psnr;
        const double adaptive = fields::difference(pictures.adaptive, truth).psnr;
        std::printf("%.1f dB, even %.1f dB\n", adaptive, even);
        EXPECT_GE(adaptive, std::min(kGoodDecibels, even - 0.5));
    }

    void expectSame(const TileSpec& tile) {
        const auto pictures = draw(tile);
        EXPECT_GE(fields::difference(pictures.even, pictures.adaptive).psnr, kSameDecibels);
    }

    /// A ball keeps what lies inside of it, or outside.
    void clipByBall(TileSpec& tile, ClipMode mode) const {
        tile.clip.object = ClipObject{
            "ball", objectOver(fields::gridOf(fields::Geometry::Isotropic, 48), grid, 0.8), mode, false};
    }

    Grid grid = fields::gridOf(fields::Geometry::Isotropic, kSamples);
    fields::AnalyticField field = fields::gaussianSum();
};

TEST_F(AdaptiveSampling, KeepsPicturesGood) {
    addBall("ball");
    add(field, grid, ScalarType::U8, "u8");
    add(field, grid, ScalarType::F32, "f32");
    for (const char* key : {"u8", "f32"})
        for (const auto& table :
             {fields::filledTable(field.low, field.high), fields::sparseTable(field.low, field.high),
              fields::peaksTable(field.low, field.high)})
            for (const bool lit : {false, true}) {
                auto tile = tileOf(key, table, lit);
                expectGood(tile);
                tile.unitLengthWorld *= 16.0; // thin: the longest strides
                expectGood(tile);
                tile.clip.planes = {planeThrough(grid, glm::dvec3(0.45), {0.3, 1.0, -0.5})};
                expectGood(tile);
                tile.clip.planes.clear();
                for (const auto mode : {ClipMode::Probe, ClipMode::Clip}) {
                    clipByBall(tile, mode);
                    expectGood(tile);
                }
            }
}

TEST_F(AdaptiveSampling, TakesFewerSamplesOfThinMatter) {
    add(field, grid, ScalarType::F32, "f32");
    auto tile = tileOf("f32", fields::filledTable(field.low, field.high), false);
    tile.unitLengthWorld *= 16.0;
    const auto pictures = draw(tile);
    EXPECT_LT(fields::difference(pictures.even, pictures.adaptive).psnr, 110.0) << "no sample is left out";
}

TEST_F(AdaptiveSampling, LeavesWhatItIsNotFor) {
    add(field, grid, ScalarType::F32, "f32");
    auto thin = tileOf("f32", fields::filledTable(field.low, field.high), false);
    thin.unitLengthWorld *= 16.0;
    auto mean = thin;
    mean.classification = Classification::PreIntegrated;
    expectSame(mean);
    auto coarse = thin;
    coarse.sampleDistanceVoxels = 4.0; // no stride is longer
    expectSame(coarse);
}

TEST_F(AdaptiveSampling, SamplesEvenlyWhereSamplesAreAbsent) {
    auto holed = field;
    holed.value = [value = field.value](const glm::dvec3& p) {
        return p.x > 0.1 && p.y > -0.2 ? std::numeric_limits<double>::quiet_NaN() : value(p);
    };
    add(holed, grid, ScalarType::F32, "holes");
    auto tile = tileOf("holes", fields::filledTable(field.low, field.high), false);
    tile.unitLengthWorld *= 16.0;
    expectSame(tile);
}

} // namespace
} // namespace voxsheet::image
