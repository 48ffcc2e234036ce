// The crosshair of planes beside a volume: where it lies, and its lines.
#include "engine/crosshair.h"

#include "engine/plane_resolver.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

/// 11 x 21 x 31 samples, one apart; the second axis points backwards: y from 50 down to 30.
Grid backwardsGrid() {
    Grid grid;
    grid.dims = {11, 21, 31};
    grid.worldFromIndex[1] = glm::dvec4(0, -1, 0, 0);
    grid.worldFromIndex[3] = glm::dvec4(-5, 50, 0, 1);
    return grid;
}

sheet::PlaneStyle crosshairAt(const glm::dvec3& at, sheet::PlaneUnits units = sheet::PlaneUnits::Fraction) {
    sheet::PlaneStyle plane;
    plane.crosshair = at;
    plane.units = units;
    return plane;
}

TEST(Crosshair, FractionsRunAlongTheWorldsAxesWhicheverWayTheVolumesRun) {
    const auto point = crosshairWorld(crosshairAt({0.5, 0.25, 0.1}), backwardsGrid()).value();
    EXPECT_NEAR(glm::distance(point, glm::dvec3(0, 35, 3)), 0.0, 1e-12);
    EXPECT_EQ(crosshairWorld(crosshairAt({7, 8, 9}, sheet::PlaneUnits::World), backwardsGrid()),
              glm::dvec3(7, 8, 9));
    EXPECT_FALSE(crosshairWorld({}, backwardsGrid()));
}

TEST(Crosshair, PlanesPassThroughItWhereverTheirPositionIs) {
    for (const auto& [axis, offset] : {std::pair{sheet::PlaneAxis::Sagittal, 0.0},
                                       {sheet::PlaneAxis::Coronal, 35.0},
                                       {sheet::PlaneAxis::Axial, 3.0}}) {
        sheet::PlaneStyle plane = crosshairAt({0.5, 0.25, 0.1});
        plane.axis = axis;
        plane.position = 0.9;
        EXPECT_NEAR(resolvePlane(plane, backwardsGrid()).offset, offset, 1e-12);
    }
}

TEST(Crosshair, OnAPlaneItsLinesCrossThePictureAndLeaveThePointFree) {
    TileSpec tile;
    tile.technique = Technique::Plane;
    tile.sizePixels = {100, 80};
    tile.camera.projection = Projection::Orthographic;
    tile.camera.heightWorld = 40.0;
    tile.camera.viewFromWorld[3] = glm::dvec4(0, -40, -100, 1); // (0, 40) in the middle, 2 pixels per unit
    const auto lines = crosshairLines(tile, backwardsGrid(), {5, 50, 0});
    ASSERT_EQ(lines.size(), 4U);
    const double x = 50 + 2 * 5;
    const double y = 40 - 2 * 10;
    EXPECT_EQ(lines[0].from, glm::dvec2(0, y));
    EXPECT_EQ(lines[1].to, glm::dvec2(100, y));
    EXPECT_EQ(lines[2].from, glm::dvec2(x, 0));
    EXPECT_EQ(lines[3].to, glm::dvec2(x, 80));
    EXPECT_LT(lines[0].to.x, x);
    EXPECT_GT(lines[1].from.x, x);
    EXPECT_EQ(crosshairLines(tile, backwardsGrid(), {500, 50, 0}).size(), 1U)
        << "the point is off the picture";
}

TEST(Crosshair, InAVolumeItsLinesRunAlongTheWorldsAxesThroughTheBox) {
    TileSpec tile;
    tile.sizePixels = {100, 100};
    tile.camera.viewFromWorld[3] = glm::dvec4(0, -40, -100, 1);
    const auto lines = crosshairLines(tile, backwardsGrid(), {1, 42, 7});
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].from, pixelAt(tile.camera, {-5, 42, 7}, tile.sizePixels));
    EXPECT_EQ(lines[1].to, pixelAt(tile.camera, {1, 50, 7}, tile.sizePixels));
    EXPECT_EQ(lines[2].from, pixelAt(tile.camera, {1, 42, 0}, tile.sizePixels));
    EXPECT_FALSE(pixelAt(tile.camera, {0, 0, 101}, tile.sizePixels)) << "behind the eye";
}

} // namespace
} // namespace voxsheet::engine
