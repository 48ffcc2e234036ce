#include "stages/banded_dispatch.h"
#include "stages/classification.h"
#include "stages/ray_frame.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet {
namespace {

Grid shearedGrid() {
    Grid grid;
    grid.dims = {20, 30, 40};
    grid.worldFromIndex[1] = {0.4, 0.8, 0.0, 0.0};
    grid.worldFromIndex[3] = {100.0, -50.0, 7.0, 1.0};
    return grid;
}

CameraSpec cameraAt(const Grid& grid, Projection projection) {
    CameraSpec camera;
    camera.projection = projection;
    camera.heightWorld = 60.0;
    camera.viewFromWorld =
        glm::lookAt(centreWorld(grid) + glm::dvec3(60.0, 45.0, 80.0), centreWorld(grid), glm::dvec3(0, 1, 0));
    return camera;
}

TEST(RayFrame, PointsOfARayProjectBackToTheirPixel) {
    const auto grid = shearedGrid();
    for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
        const auto camera = cameraAt(grid, projection);
        const auto frame = makeRayFrame(camera, {320, 200}, grid);
        for (const glm::dvec2 relative : {glm::dvec2(0.0), glm::dvec2(0.9, -0.4), glm::dvec2(-0.3, 0.8)})
            for (const double s : {-0.7, 0.0, 0.6}) {
                const auto q = relative * frame.pictureHalf;
                const auto texture = frame.origin + q.x * frame.originX + q.y * frame.originY +
                                     s * (frame.direction + q.x * frame.directionX + q.y * frame.directionY);
                const auto view = camera.viewFromWorld * worldFromTexture(grid) * glm::dvec4(texture, 1.0);
                EXPECT_NEAR(-view.z, frame.centreDepthWorld + s * frame.radiusWorld, 1e-9);
                const double half =
                    projection == Projection::Perspective ? std::tan(glm::radians(15.0)) * -view.z : 30.0;
                EXPECT_NEAR(view.x / (half * 1.6), relative.x, 1e-9);
                EXPECT_NEAR(view.y / half, relative.y, 1e-9);
            }
    }
}

TEST(RayFrame, TheNearestDepthIsTheEyeInPerspectiveAndBeforeTheBoxOtherwise) {
    const auto grid = shearedGrid();
    const auto perspective = makeRayFrame(cameraAt(grid, Projection::Perspective), {100, 100}, grid);
    EXPECT_NEAR(perspective.nearest * perspective.radiusWorld, -perspective.centreDepthWorld, 1e-9);
    EXPECT_LE(makeRayFrame(cameraAt(grid, Projection::Orthographic), {100, 100}, grid).nearest, -1.0);
}

TEST(RayFrame, TheBoxOfPeriodicGridsReachesTheFirstSampleAgain) {
    auto grid = shearedGrid();
    grid.periodic = {true, false, false};
    const auto frame = makeRayFrame(cameraAt(grid, Projection::Perspective), {100, 100}, grid);
    EXPECT_DOUBLE_EQ(frame.boxLow.x, 0.5 / 20);
    EXPECT_DOUBLE_EQ(frame.boxHigh.x, 1.0 + 0.5 / 20);
    EXPECT_DOUBLE_EQ(frame.boxHigh.y, 1.0 - 0.5 / 30);
    const auto window = makeRayFrame(cameraAt(grid, Projection::Perspective), {100, 100}, grid,
                                     {{0.25, 0.0, 0.0}, {3, 1, 1}});
    EXPECT_DOUBLE_EQ(window.boxLow.x, 0.5 / 20 - 0.25);
    EXPECT_DOUBLE_EQ(window.boxHigh.x, 3.0 + 0.5 / 20 - 0.25);
    EXPECT_DOUBLE_EQ(window.boxHigh.y, 1.0 - 0.5 / 30);
}

TEST(Classification, TexelsMapToTheEntriesOfTheirValues) {
    for (const auto scale : {ValueScale::Linear, ValueScale::Log, ValueScale::SymLog}) {
        TransferTable table;
        table.low = scale == ValueScale::Log ? 0.01 : -3.0;
        table.high = 50.0;
        table.scale = scale;
        table.symLogThreshold = 0.5;
        table.entries.resize(101);
        const double valueScale = 80.0;
        const double valueOffset = -5.0;
        const auto mapping = classificationMapping(table, valueScale, valueOffset);
        for (double value = 0.02; value < 50.0; value *= 1.3) {
            const double texel = (value - valueOffset) / valueScale;
            double mapped = texel * mapping.mappedFromTexel.x + mapping.mappedFromTexel.y;
            if (scale == ValueScale::Log) mapped = std::log2(mapped);
            if (scale == ValueScale::SymLog && std::abs(mapped) > 1.0)
                mapped = std::copysign(1.0 + std::log(std::abs(mapped)), mapped);
            const double entry = mapped * mapping.entryFromMapped.x + mapping.entryFromMapped.y;
            EXPECT_NEAR(entry, 1.5 + 100.0 * tablePosition(table, value), 1e-9) << value;
        }
    }
}

TEST(Classification, ExtinctionsGiveTheOpacityBack) {
    TransferTable table;
    table.entries = {{1, 0, 0, 0.0F}, {0, 1, 0, 0.25F}, {0, 0, 1, 1.0F}};
    table.below = {0.5, 0.5, 0.5, 0.5F};
    table.above = table.entries.back();
    const auto texels = shaderTable(table);
    ASSERT_EQ(texels.size(), 5U);
    EXPECT_FLOAT_EQ(texels[0].w, 1.0F);
    EXPECT_FLOAT_EQ(texels[1].w, 0.0F);
    EXPECT_NEAR(1.0 - std::exp2(-double(texels[2].w)), 0.25, 1e-7);
    EXPECT_FLOAT_EQ(1.0F - std::exp2(-0.1F * texels[3].w), 1.0F);
}

TEST(BandedDispatch, BandsAreWholeGroupsAndBounded) {
    EXPECT_GE(rowsPerDispatch({512, 512}, 900.0), 512);
    const int rows = rowsPerDispatch({8192, 8192}, 4000.0);
    EXPECT_EQ(rows % 8, 0);
    EXPECT_LE(double(rows) * 8192 * 4000, 0x1p30);
    EXPECT_EQ(rowsPerDispatch({8192, 8192}, 1e9), 8);
}

} // namespace
} // namespace voxsheet
