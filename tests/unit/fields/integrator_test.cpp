#include "fields/integrator.h"

#include "fields/scenes.h"
#include "volume/memory_volume_provider.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace voxsheet::fields {
namespace {

TEST(AnalyticField, GradientsAreDerivatives) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-0.9, 0.9);
    for (const auto& field :
         {linearRamp(), sphereDistance(), torusDistance(), marschnerLobb(), gaussianSum()})
        for (int trial = 0; trial < 100; ++trial) {
            const glm::dvec3 p(uniform(random), uniform(random), uniform(random));
            EXPECT_GE(field.value(p), field.low) << field.name;
            EXPECT_LE(field.value(p), field.high) << field.name;
            const auto gradient = field.gradient(p);
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0.0);
                step[axis] = 1e-6;
                EXPECT_NEAR(gradient[axis], (field.value(p + step) - field.value(p - step)) / 2e-6, 1e-6)
                    << field.name;
            }
        }
}

TEST(AnalyticField, LineIntegralsMatchTheirSums) {
    const glm::dvec3 a(-0.9, 0.3, 0.8);
    const glm::dvec3 b(0.7, -0.5, -0.6);
    for (const auto& field : {linearRamp(), gaussianSum()}) {
        double sum = 0.0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i)
            sum += field.value(a + (b - a) * ((i + 0.5) / steps));
        EXPECT_NEAR(field.lineIntegral(a, b), sum / steps * glm::distance(a, b), 1e-8) << field.name;
    }
}

/// Opacity that makes the extinction proportional to the value: the integral along a ray then has a closed
/// form.
TEST(Integrator, ConvergesToTheClosedForm) {
    const auto field = gaussianSum();
    constexpr double strength = 3.0; // extinction = strength * value, per world unit
    Grid grid;
    grid.dims = glm::ivec3(64);
    grid.centring = Centring::Cell;
    // Texture [0, 1] to the world's [-1, 1]: the field's own coordinates.
    glm::dmat4 worldFromTextureWanted(2.0);
    worldFromTextureWanted[3] = {-1.0, -1.0, -1.0, 1.0};
    grid.worldFromIndex = worldFromTextureWanted * textureFromIndex(grid);

    auto table = std::make_shared<TransferTable>();
    table->low = 0.0;
    table->high = field.high;
    for (int i = 0; i <= 4000; ++i)
        table->entries.emplace_back(0.25F, 0.5F, 1.0F,
                                    static_cast<float>(1.0 - std::exp(-strength * field.high * i / 4000.0)));
    table->below = table->entries.front();
    table->above = table->entries.back();

    auto tile = tileOf("closed form", grid, Technique::Raycast, 24);
    tile.unitLengthWorld = 1.0;
    tile.transfer = table;
    const auto value = [&](const glm::dvec3& texture) { return field.value(2.0 * texture - 1.0); };
    for (const auto technique : {Technique::Raycast, Technique::Slices}) {
        tile.technique = technique;
        const auto converged = integrateConverged(tile, grid, grid.dims, value, 1.0 / 8.0);
        const auto worldFromView = glm::inverse(tile.camera.viewFromWorld);
        int compared = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const double tangent = std::tan(glm::radians(15.0));
                const glm::dvec3 direction = glm::normalize(
                    glm::dmat3(worldFromView) *
                    glm::dvec3(((x + 0.5) / 12.0 - 1.0) * tangent, ((y + 0.5) / 12.0 - 1.0) * tangent, -1.0));
                const glm::dvec3 eye(worldFromView[3]);
                const auto t1 = (glm::dvec3(-1.0) - eye) / direction;
                const auto t2 = (glm::dvec3(1.0) - eye) / direction;
                const auto near = glm::min(t1, t2);
                const auto far = glm::max(t1, t2);
                const double enter = std::max({near.x, near.y, near.z});
                const double leave = std::min({far.x, far.y, far.z});
                const double depth =
                    enter < leave ? field.lineIntegral(eye + enter * direction, eye + leave * direction)
                                  : 0.0;
                const double alpha = 1.0 - std::exp(-strength * depth);
                EXPECT_NEAR(converged.at(x, y).w, alpha, 1e-5);
                EXPECT_NEAR(converged.at(x, y).x, 0.25 * alpha, 1e-5);
                if (alpha > 0.01) ++compared;
            }
        EXPECT_GT(compared, 100);
    }
}

TEST(Integrator, CoarserSamplesAreFartherFromTheTruth) {
    const auto field = marschnerLobb();
    const auto grid = gridOf(Geometry::Isotropic, 24);
    auto tile = tileOf("order", grid, Technique::Raycast, 32);
    tile.transfer = filledTable(field.low, field.high);
    const auto value = [&](const glm::dvec3& texture) { return field.value(2.0 * texture - 1.0); };
    const auto truth = integrateConverged(tile, grid, grid.dims, value, 1.0 / 64.0);
    double before = 0.0;
    for (const double distance : {4.0, 1.0, 0.25}) {
        tile.sampleDistanceVoxels = distance;
        const auto psnr = difference(integrateLikeTechnique(tile, grid, grid.dims, value), truth).psnr;
        EXPECT_GT(psnr, before);
        before = psnr;
    }
    EXPECT_GT(before, 60.0);
}

TEST(Integrator, EveryNthPixelIsThatPixelOfTheWhole) {
    const auto field = gaussianSum();
    const auto grid = gridOf(Geometry::Sheared, 16);
    auto tile = tileOf("every", grid, Technique::Raycast, 30);
    tile.transfer = filledTable(field.low, field.high);
    const auto value = [&](const glm::dvec3& texture) { return field.value(2.0 * texture - 1.0); };
    const auto whole = integrateConverged(tile, grid, grid.dims, value, 0.5);
    const auto some = integrateConverged(tile, grid, grid.dims, value, 0.5, 4);
    EXPECT_EQ(some.size, glm::ivec2(8));
    EXPECT_EQ(everyNth(whole, 4).pixels, some.pixels);
}

TEST(Interpolant, GivesSamplesBackAndIsTrilinearBetween) {
    for (const auto type :
         {ScalarType::U8, ScalarType::I16, ScalarType::U16, ScalarType::F32, ScalarType::F64}) {
        Grid grid;
        grid.dims = {6, 5, 4};
        grid.periodic = {true, false, false};
        const auto field = linearRamp();
        auto sampled = sampleField(field, grid, type, "ramp");
        MemoryVolumeProvider provider;
        provider.add(sampled.meta, sampled.arrays);
        const Interpolant interpolant(provider, {"ramp", 0, 0, 0});
        const double step = isFloat(type) ? 1e-6 : 0.51 * sampled.meta.fields[0].valueScale;
        for (const glm::dvec3 index :
             {glm::dvec3(0, 0, 0), glm::dvec3(5, 4, 3), glm::dvec3(2.25, 1.5, 0.75)}) {
            const auto texture = (index + 0.5) / glm::dvec3(grid.dims);
            EXPECT_NEAR(interpolant.at(texture), field.value(2.0 * texture - 1.0), step) << scalarName(type);
        }
        // Half way from the last sample to the first one on the periodic axis; beyond the end on a clamped
        // one.
        const auto at = [&](double x, double y) {
            return interpolant.at((glm::dvec3(x, y, 1.0) + 0.5) / glm::dvec3(grid.dims));
        };
        EXPECT_NEAR(at(5.5, 1.0), 0.5 * (at(5.0, 1.0) + at(0.0, 1.0)), 1e-12);
        EXPECT_NEAR(at(1.0, 4.9), at(1.0, 4.0), 1e-12);
    }
}

TEST(Difference, IsOverPixelsThatAreBackgroundInNeither) {
    Picture a({4, 1});
    Picture b({4, 1});
    a.at(0, 0) = {0.5, 0.5, 0.5, 1.0};
    b.at(0, 0) = {0.6, 0.5, 0.5, 1.0};
    a.at(1, 0) = {0.9, 0.9, 0.9, 1.0}; // background in b
    const auto result = difference(a, b);
    EXPECT_EQ(result.pixels, 1U);
    EXPECT_NEAR(result.psnr, -10.0 * std::log10(0.01 / 3.0), 1e-9);
    EXPECT_NEAR(result.p999, 0.1, 1e-12);
    EXPECT_EQ(difference(a, a).psnr, 200.0);
}

} // namespace
} // namespace voxsheet::fields
