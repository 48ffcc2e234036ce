// The corners of what a tile can ask for: each against the integrator, or against a closed form.
#include "base/errors.h"
#include "fields/integrator.h"
#include "fields/scenes.h"
#include "image/tile_painter.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace voxsheet::image {
namespace {

constexpr double kRequiredPsnr = 45.0;
constexpr int kPixels = 96;
constexpr Technique kAll[] = {Technique::Raycast, Technique::Slices, Technique::Mip};

class TechniqueCases : public testing::Test {
protected:
    void add(const fields::AnalyticField& field, const Grid& grid, ScalarType type, const std::string& key) {
        add(fields::sampleField(field, grid, type, key));
    }
    void add(fields::SampledField sampled) {
        painter.volumes().add(std::move(sampled.meta), std::move(sampled.arrays));
    }

    /// Draws, compares with the integrator at the same positions, returns the picture.
    fields::Picture agree(const TileSpec& tile, std::size_t leastPixels = 500) {
        const auto meta = painter.volumes().describe(tile.dataset);
        const fields::Interpolant interpolant(painter.volumes(),
                                              {tile.dataset, tile.field, tile.step, tile.level});
        const auto picture = painter.draw(tile);
        const auto same =
            fields::difference(picture, fields::integrateLikeTechnique(tile, meta->grid, interpolant.dims(),
                                                                       [&](const glm::dvec3& texture) {
                                                                           return interpolant.at(texture);
                                                                       }));
        EXPECT_GE(same.psnr, kRequiredPsnr) << fields::nameOf(tile.technique);
        EXPECT_GE(same.psnrAlpha, kRequiredPsnr) << fields::nameOf(tile.technique);
        EXPECT_GE(same.pixels, leastPixels) << fields::nameOf(tile.technique);
        return picture;
    }

    TilePainter painter;
};

TEST_F(TechniqueCases, UniformMaterialMatchesTheClosedForm) {
    Grid grid = fields::gridOf(fields::Geometry::Anisotropic, 24);
    fields::AnalyticField constant = fields::linearRamp(glm::dvec3(0.0));
    constant.low = 0.0;
    constant.high = 1.0;
    add(constant, grid, ScalarType::F32, "constant");
    TransferFunction function;
    function.colours = {{0.0, {0.25, 0.5, 1.0}}};
    function.opacities = {{0.0, 0.08}};
    for (const auto technique : {Technique::Raycast, Technique::Slices}) {
        auto tile =
            fields::tileOf("constant", grid, technique, 1); // one pixel: the central ray, straight along z
        tile.camera = fields::cameraOf(grid, Projection::Perspective, 0.0, 0.0);
        tile.transfer = buildTransferTable(function);
        tile.sampleDistanceVoxels = 0.5;
        tile.unitLengthWorld = 2.5;
        const double path = 23 * 1.6;
        const double alpha = 1.0 - std::pow(1.0 - 0.08, path / 2.5);
        const auto pixel = painter.draw(tile).at(0, 0);
        EXPECT_NEAR(pixel.w, alpha, 2e-5) << fields::nameOf(technique);
        EXPECT_NEAR(pixel.x, 0.25 * alpha, 2e-5) << fields::nameOf(technique);
        EXPECT_NEAR(pixel.z, alpha, 2e-5) << fields::nameOf(technique);
    }
}

TEST_F(TechniqueCases, SkippingEmptySpaceChangesNoPixel) {
    const auto field = fields::gaussianSum();
    Grid grid = fields::gridOf(fields::Geometry::Sheared, 67);
    grid.periodic = {true, false, true};
    add(field, grid, ScalarType::U16, "gauss");
    for (const auto technique : kAll)
        for (const double distance : {0.23, 0.5, 1.7, 9.0}) {
            auto tile = fields::tileOf("gauss", grid, technique, kPixels);
            tile.transfer = fields::sparseTable(field.low, field.high);
            tile.sampleDistanceVoxels = distance;
            painter.techniques().setEmptySpaceSkipping(true);
            const auto skipped = painter.draw(tile);
            painter.techniques().setEmptySpaceSkipping(false);
            const auto whole = painter.draw(tile);
            painter.techniques().setEmptySpaceSkipping(true);
            const bool same = painter.filtersExactly() ? skipped.pixels == whole.pixels
                                                       : fields::difference(skipped, whole).psnr > 100.0;
            EXPECT_TRUE(same) << fields::nameOf(technique) << " at " << distance;
            EXPECT_GT(fields::difference(skipped, whole).pixels, 100U)
                << fields::nameOf(technique) << " at " << distance;
        }
}

TEST_F(TechniqueCases, PeriodicAxesWrapAndDrawTheClosingSlab) {
    Grid grid = fields::gridOf(fields::Geometry::Sheared, 20);
    grid.periodic = glm::bvec3(true);
    fields::AnalyticField waves;
    waves.name = "waves";
    waves.low = -3.0;
    waves.high = 3.0;
    waves.value = [](const glm::dvec3& p) {
        return std::sin(M_PI * p.x) + std::cos(M_PI * p.y) + std::sin(M_PI * p.z + 1.0);
    };
    add(waves, grid, ScalarType::F32, "waves");
    Grid open = grid;
    open.periodic = glm::bvec3(false);
    add(waves, open, ScalarType::F32, "open");
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("waves", grid, technique, kPixels);
        tile.transfer = fields::filledTable(-3.0, 3.0);
        const auto closed = agree(tile);
        tile.dataset = "open";
        tile.camera = fields::cameraOf(grid, Projection::Perspective);
        const auto withoutSlab = agree(tile);
        EXPECT_LT(fields::difference(closed, withoutSlab).psnr, 60.0) << "the closing slab is not seen";
    }
}

TEST_F(TechniqueCases, NanIsAbsent) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 32);
    auto sampled = fields::sampleField(field, grid, ScalarType::F32, "holes");
    for (int z = 0; z < 32; ++z)
        for (int y = 10; y < 18; ++y)
            for (int x = 4; x < 20; ++x) {
                const float nan = std::numeric_limits<float>::quiet_NaN();
                std::memcpy(sampled.arrays[0].data() +
                                sizeof(float) * static_cast<std::size_t>((z * 32 + y) * 32 + x),
                            &nan, sizeof nan);
            }
    add(std::move(sampled));
    add(field, grid, ScalarType::F32, "whole");
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("holes", grid, technique, kPixels);
        tile.transfer = fields::filledTable(field.low, field.high);
        const auto holes = agree(tile);
        tile.dataset = "whole";
        EXPECT_LT(fields::difference(holes, painter.draw(tile)).psnr, 60.0) << fields::nameOf(technique);
    }
}

TEST_F(TechniqueCases, AVolumeOfNanIsTransparent) {
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 12);
    auto sampled = fields::sampleField(fields::gaussianSum(), grid, ScalarType::F32, "nan");
    const std::vector<float> nans(static_cast<std::size_t>(sampleCount(grid.dims)), std::nanf(""));
    std::memcpy(sampled.arrays[0].data(), nans.data(), nans.size() * sizeof(float));
    add(std::move(sampled));
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("nan", grid, technique, 16);
        tile.transfer = fields::filledTable(0.0, 1.0);
        for (const auto& pixel : painter.draw(tile).pixels)
            EXPECT_EQ(pixel, glm::dvec4(0.0)) << fields::nameOf(technique);
    }
}

TEST_F(TechniqueCases, CoarserLevelsFillTheSameBox) {
    const auto field = fields::gaussianSum();
    Grid grid = fields::gridOf(fields::Geometry::Anisotropic, 45);
    grid.dims = {45, 38, 61};
    add(field, grid, ScalarType::U16, "levels");
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("levels", grid, technique, kPixels);
        tile.transfer = fields::filledTable(field.low, field.high);
        const auto full = agree(tile);
        tile.level = 1;
        const auto half = agree(tile);
        const auto change = fields::difference(full, half);
        EXPECT_GT(change.psnr, 25.0) << fields::nameOf(technique);
        EXPECT_GT(half.pixels.size(), 0U);
    }
}

TEST_F(TechniqueCases, TheEyeMayBeInsideTheVolume) {
    const auto field = fields::marschnerLobb();
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const auto grid = fields::gridOf(geometry, 32);
        const auto key = std::string("inside ") + fields::nameOf(geometry);
        add(field, grid, ScalarType::F32, key);
        for (const auto technique : kAll) {
            auto tile = fields::tileOf(key, grid, technique, kPixels);
            tile.transfer = fields::filledTable(field.low, field.high);
            const auto centre = centreWorld(grid);
            tile.camera.viewFromWorld =
                glm::lookAt(centre + glm::dvec3(2.1, -1.3, 3.7), centre + glm::dvec3(9.0, 4.0, -7.0),
                            glm::dvec3(0.0, 1.0, 0.0));
            tile.camera.fovYDegrees = 70.0;
            (void)agree(tile, kPixels * kPixels * 9 / 10);
        }
    }
}

TEST_F(TechniqueCases, FarEyesAndSmallWorldsKeepPrecision) {
    const auto field = fields::gaussianSum();
    Grid grid = fields::gridOf(fields::Geometry::Isotropic, 32);
    grid.worldFromIndex = glm::translate(glm::dmat4(1.0), glm::dvec3(3e-7, -2e-7, 1e-7)) *
                          glm::scale(glm::dmat4(1.0), glm::dvec3(2.5e-10)); // crystals in metres
    add(field, grid, ScalarType::U16, "small");
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("small", grid, technique, kPixels);
        tile.transfer = fields::filledTable(field.low, field.high);
        const auto centre = centreWorld(grid);
        const double distance = 2000.0 * boundingRadiusWorld(grid);
        tile.camera.viewFromWorld = glm::lookAt(centre + distance * glm::normalize(glm::dvec3(1.0, 0.7, 0.4)),
                                                centre, glm::dvec3(0.0, 1.0, 0.0));
        tile.camera.fovYDegrees = 0.05;
        (void)agree(tile);
    }
}

TEST_F(TechniqueCases, ViewsAlongAnAxisAndWidePictures) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 32);
    add(field, grid, ScalarType::U8, "axis");
    for (const auto technique : kAll)
        for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
            auto tile = fields::tileOf("axis", grid, technique, kPixels);
            tile.transfer = fields::filledTable(field.low, field.high);
            tile.sizePixels = {131, 53};
            tile.camera = fields::cameraOf(grid, projection, 90.0, 0.0);
            (void)agree(tile, 400);
        }
}

TEST_F(TechniqueCases, LogarithmicScalesResolveAllDecades) {
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 40);
    fields::AnalyticField decades = fields::gaussianSum();
    const auto base = decades.value;
    decades.value = [base](const glm::dvec3& p) { return 1e-5 * std::pow(10.0, 4.5 * base(p)); };
    add(decades, grid, ScalarType::F32, "decades");
    fields::AnalyticField both = decades;
    both.value = [base](const glm::dvec3& p) { return (base(p) - 0.4) * std::pow(10.0, 3.0 * base(p)); };
    add(both, grid, ScalarType::F32, "both signs");
    for (const auto technique : kAll)
        for (const bool log : {true, false}) {
            auto tile = fields::tileOf(log ? "decades" : "both signs", grid, technique, kPixels);
            TransferFunction function;
            function.scale = log ? ValueScale::Log : ValueScale::SymLog;
            function.low = log ? 1e-5 : -100.0;
            function.high = log ? 1.0 : 100.0;
            function.shape = TransferShape::Linear;
            function.cut1 = 0.3;
            function.opacities = {{0.0, 0.0}, {0.2, 0.01}, {1.0, 0.1}};
            tile.transfer = buildTransferTable(function);
            (void)agree(tile);
        }
}

TEST_F(TechniqueCases, ColoursBelowAndAboveTheRange) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 40);
    add(field, grid, ScalarType::F32, "outside");
    TransferFunction function;
    function.colours = {{0.0, {0.2, 0.2, 0.2}}, {1.0, {0.8, 0.8, 0.8}}};
    function.opacities = {{0.0, 0.02}, {1.0, 0.05}};
    function.low = 0.2;
    function.high = 0.6;
    function.hasBelow = function.hasAbove = true;
    function.below = {0.0, 0.0, 1.0, 0.01};
    function.above = {1.0, 0.0, 0.0, 0.2};
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("outside", grid, technique, kPixels);
        tile.transfer = buildTransferTable(function);
        const auto picture = agree(tile);
        double most = 0.0;
        for (const auto& pixel : picture.pixels)
            most = std::max(most, pixel.x - pixel.y);
        EXPECT_GT(most, 0.1) << fields::nameOf(technique) << ": no red of the values above";
    }
}

TEST_F(TechniqueCases, NegativeSlopesTurnTheMaximumAround) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 32);
    auto sampled = fields::sampleField(field, grid, ScalarType::U8, "negative");
    auto& meta = sampled.meta.fields[0];
    meta.valueOffset = meta.valueOffset + 255.0 * meta.valueScale;
    meta.valueScale = -meta.valueScale;
    add(std::move(sampled));
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("negative", grid, technique, kPixels);
        tile.transfer = fields::filledTable(field.low, field.high);
        (void)agree(tile);
    }
}

TEST_F(TechniqueCases, ThinVolumesAreDrawn) {
    const auto field = fields::linearRamp();
    Grid grid = fields::gridOf(fields::Geometry::Isotropic, 32);
    grid.dims = {32, 20, 1};
    add(field, grid, ScalarType::U16, "thin");
    for (const auto technique : kAll) {
        auto tile = fields::tileOf("thin", grid, technique, kPixels);
        tile.camera = fields::cameraOf(grid, Projection::Perspective, 15.0, 10.0);
        TransferFunction function;
        function.colours = {{0.0, {0.0, 0.0, 1.0}}, {1.0, {1.0, 0.0, 0.0}}};
        function.opacities = {{0.0, 0.5}};
        tile.transfer = buildTransferTable(function);
        (void)agree(tile, 400);
    }
}

TEST_F(TechniqueCases, SampleDistanceDoesNotChangeOpacity) {
    const auto field = fields::gaussianSum();
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Anisotropic}) {
        const auto grid = fields::gridOf(geometry, 48);
        const auto key = std::string("distance ") + fields::nameOf(geometry);
        add(field, grid, ScalarType::U16, key);
        for (const auto technique : {Technique::Raycast, Technique::Slices}) {
            auto tile = fields::tileOf(key, grid, technique, kPixels);
            tile.transfer = fields::filledTable(field.low, field.high);
            tile.sampleDistanceVoxels = 0.2;
            const auto fine = painter.draw(tile);
            tile.sampleDistanceVoxels = 1.6;
            const auto change = fields::difference(fine, painter.draw(tile));
            EXPECT_GT(change.psnr, 40.0) << fields::nameOf(technique);
            EXPECT_LT(change.psnr, 120.0)
                << fields::nameOf(technique) << ": the distance had no effect at all";
        }
    }
}

TEST_F(TechniqueCases, RefusesNumbersOutOfRange) {
    const auto field = fields::linearRamp();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 8);
    add(field, grid, ScalarType::U8, "refuse");
    const auto refusedField = [&](auto spoil) {
        auto tile = fields::tileOf("refuse", grid, Technique::Raycast, 8);
        tile.transfer = fields::filledTable(0.0, 1.0);
        spoil(tile);
        try {
            (void)painter.draw(tile);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("drawn");
    };
    EXPECT_EQ(refusedField([](TileSpec&) {}), "drawn");
    EXPECT_EQ(refusedField([](TileSpec& t) { t.sampleDistanceVoxels = 0.0; }), "sampling.distance");
    EXPECT_EQ(refusedField([](TileSpec& t) { t.sampleDistanceVoxels = 65.0; }), "sampling.distance");
    EXPECT_EQ(refusedField([](TileSpec& t) { t.unitLengthWorld = std::nan(""); }), "transfer.unitLength");
    EXPECT_EQ(refusedField([](TileSpec& t) { t.camera.fovYDegrees = 180.0; }), "camera.fov");
    EXPECT_EQ(refusedField([](TileSpec& t) { t.camera.viewFromWorld[0][0] = std::nan(""); }),
              "camera.target");
    EXPECT_EQ(refusedField([](TileSpec& t) { t.transfer = nullptr; }), "transfer.map");
}

} // namespace
} // namespace voxsheet::image
