#include "engine/clip_resolver.h"

#include "base/errors.h"
#include "memory_dataset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::engine {
namespace {

using Plane = sheet::ClipStyle::Plane;

/// A sheared, anisotropic, rotated cell far from the origin.
Grid obliqueGrid() {
    Grid grid;
    grid.dims = {20, 30, 12};
    grid.worldFromIndex = glm::translate(glm::dmat4(1.0), glm::dvec3(100.0, -40.0, 7.0)) *
                          glm::dmat4(glm::dmat3(glm::dvec3(0.5, 0.1, 0.0), glm::dvec3(-0.2, 0.4, 0.1),
                                                glm::dvec3(0.3, 0.0, 0.8)));
    grid.periodic = {true, true, false};
    return grid;
}

Grid cube(int samples, double spacing, const glm::dvec3& origin) {
    Grid grid;
    grid.dims = glm::ivec3(samples);
    grid.worldFromIndex = glm::scale(glm::translate(glm::dmat4(1.0), origin), glm::dvec3(spacing));
    grid.centring = Centring::Cell;
    return grid;
}

glm::dvec3 atFraction(const Grid& grid, const glm::dvec3& fraction) {
    const IndexBox box = boxIndex(grid);
    return glm::dvec3(grid.worldFromIndex * glm::dvec4(glm::mix(box.low, box.high, fraction), 1.0));
}

bool keeps(const std::vector<ClipPlane>& planes, const glm::dvec3& p) {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const ClipPlane& plane) { return glm::dot(plane.normal, p) >= plane.offset; });
}

glm::dvec3 inObject(const ClipObject& object, const glm::dvec3& world) {
    return glm::dvec3(object.objectFromWorld * glm::dvec4(world, 1.0));
}

TEST(ClipResolver, AFractionRunsFromTheBoxesFirstCornerAlongTheNormalToItsLast) {
    const Grid grid = obliqueGrid();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, 2.0, -3.0));
    double first = 1e300;
    double last = -1e300;
    for (int corner = 0; corner < 8; ++corner) {
        const double at =
            glm::dot(normal, atFraction(grid, {corner & 1, (corner >> 1) & 1, (corner >> 2) & 1}));
        first = std::min(first, at);
        last = std::max(last, at);
    }
    for (const double length : {1e-200, 1.0, 1e200}) {
        sheet::ClipStyle clip;
        clip.planes = {Plane{glm::dvec3(1.0, 2.0, -3.0) * length, 0.25}};
        const auto planes = resolveClipPlanes(clip, grid);
        ASSERT_EQ(planes.size(), 1U);
        EXPECT_NEAR(glm::length(planes[0].normal), 1.0, 1e-12);
        EXPECT_NEAR(glm::distance(planes[0].normal, normal), 0.0, 1e-12) << length;
        EXPECT_NEAR(planes[0].offset, first + 0.25 * (last - first), 1e-9) << length;
    }
}

TEST(ClipResolver, AWorldPositionIsADistanceFromTheOriginAlongTheUnitNormal) {
    sheet::ClipStyle clip;
    clip.units = sheet::ClipUnits::World;
    clip.planes = {Plane{{0.0, 0.0, 5.0}, 3.0}};
    const auto planes = resolveClipPlanes(clip, cube(10, 1.0, {0.0, 0.0, 0.0}));
    ASSERT_EQ(planes.size(), 1U);
    EXPECT_EQ(planes[0].normal, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(planes[0].offset, 3.0);
}

TEST(ClipResolver, APlaneThatCutsNothingIsLeftOutAndOneBeyondTheBoxStaysNearIt) {
    const Grid grid = cube(10, 1.0, {0.0, 0.0, 0.0});
    for (const auto units : {sheet::ClipUnits::Fraction, sheet::ClipUnits::World}) {
        sheet::ClipStyle clip;
        clip.units = units;
        clip.planes = {Plane{{1.0, 0.0, 0.0}, -1e300}};
        EXPECT_TRUE(resolveClipPlanes(clip, grid).empty());
        clip.planes = {Plane{{1.0, 0.0, 0.0}, units == sheet::ClipUnits::World ? -0.5 : 0.0}};
        EXPECT_TRUE(resolveClipPlanes(clip, grid).empty());
        clip.planes = {Plane{{1.0, 0.0, 0.0}, 1e300}};
        const auto planes = resolveClipPlanes(clip, grid);
        ASSERT_EQ(planes.size(), 1U);
        EXPECT_GT(planes[0].offset, 9.5);
        EXPECT_LT(planes[0].offset, 100.0);
    }
}

TEST(ClipResolver, ABoxInFractionsFollowsTheVolumesOwnAxesAlsoWhereTheyAreOblique) {
    const Grid grid = obliqueGrid();
    sheet::ClipStyle clip;
    clip.box = sheet::ClipStyle::Box{{0.2, 0.3, 0.1}, {0.7, 0.9, 0.6}};
    const auto planes = resolveClipPlanes(clip, grid);
    ASSERT_EQ(planes.size(), 6U);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int kept = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 f(uniform(random), uniform(random), uniform(random));
        const bool inside = glm::all(glm::greaterThanEqual(f, clip.box->low)) &&
                            glm::all(glm::lessThanEqual(f, clip.box->high));
        EXPECT_EQ(keeps(planes, atFraction(grid, f)), inside);
        kept += inside ? 1 : 0;
    }
    EXPECT_GT(kept, 100);
    clip.box = sheet::ClipStyle::Box{{0.0, -2.0, 0.1}, {1.0, 3.0, 1.0}};
    EXPECT_EQ(resolveClipPlanes(clip, grid).size(), 1U) << "only the face that cuts";
}

TEST(ClipResolver, ABoxInWorldUnitsFollowsTheWorldsAxes) {
    const Grid grid = obliqueGrid();
    const glm::dvec3 middle = centreWorld(grid);
    sheet::ClipStyle clip;
    clip.units = sheet::ClipUnits::World;
    clip.box = sheet::ClipStyle::Box{middle - 0.5, middle + glm::dvec3(0.5, 1.0, 0.25)};
    const auto planes = resolveClipPlanes(clip, grid);
    ASSERT_EQ(planes.size(), 6U);
    EXPECT_TRUE(keeps(planes, middle));
    EXPECT_TRUE(keeps(planes, middle + glm::dvec3(0.0, 0.99, 0.0)));
    EXPECT_FALSE(keeps(planes, middle + glm::dvec3(0.0, 1.01, 0.0)));
    EXPECT_FALSE(keeps(planes, middle - glm::dvec3(0.0, 0.0, 0.51)));
}

TEST(ClipResolver, AnAnalyticShapeReachesHalfTheShortestEdgeFromTheBoxesCentre) {
    Grid grid = cube(10, 1.0, {3.0, 4.0, 5.0});
    grid.dims = {10, 6, 20};
    sheet::ClipStyle clip;
    const ClipObject object = resolveClipObject(clip, {"clip-shape:sphere", {}}, grid);
    EXPECT_EQ(object.dataset, "clip-shape:sphere");
    const glm::dvec3 centre = centreWorld(grid);
    EXPECT_NEAR(glm::length(inObject(object, centre)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(inObject(object, centre + glm::dvec3(0.0, 3.0, 0.0)), {0.0, 1.0, 0.0}), 0.0,
                1e-12);
    EXPECT_NEAR(glm::distance(inObject(object, centre + glm::dvec3(3.0, 0.0, 0.0)), {1.0, 0.0, 0.0}), 0.0,
                1e-12);
    clip.units = sheet::ClipUnits::World;
    EXPECT_EQ(resolveClipObject(clip, {"clip-shape:sphere", {}}, grid).objectFromWorld, glm::dmat4(1.0));
}

TEST(ClipResolver, TheTransformScalesThenTurnsAboutXYZThenMoves) {
    const Grid grid = cube(10, 1.0, {0.0, 0.0, 0.0});
    sheet::ClipStyle clip;
    clip.units = sheet::ClipUnits::World;
    clip.transform.translation = {10.0, 20.0, 30.0};
    clip.transform.rotationDegrees = {90.0, 90.0, 0.0};
    clip.transform.scale = {2.0, 3.0, 4.0};
    const ClipObject object = resolveClipObject(clip, {"m", grid}, grid);
    // (0, 1, 0) * 3 turns about x to (0, 0, 3), then about y to (3, 0, 0).
    EXPECT_NEAR(glm::distance(inObject(object, {13.0, 20.0, 30.0}), {0.0, 1.0, 0.0}), 0.0, 1e-12);
    // (1, 0, 0) * 2 stays about x, then about y to (0, 0, -2).
    EXPECT_NEAR(glm::distance(inObject(object, {10.0, 20.0, 28.0}), {1.0, 0.0, 0.0}), 0.0, 1e-12);
    EXPECT_EQ(object.objectFromWorld[3][3], 1.0);
    EXPECT_EQ(object.objectFromWorld[0][3], 0.0);
}

TEST(ClipResolver, FractionsFitAMeshIntoEveryCellAndMoveItInUnitsOfTheBox) {
    const Grid mesh = cube(40, 0.1, {-7.0, 50.0, 3.0});
    const Grid cell = cube(10, 1.0, {3.0, 4.0, 5.0});
    sheet::ClipStyle clip;
    const glm::dvec3 centre = centreWorld(cell);
    const ClipObject fitted = resolveClipObject(clip, {"m", mesh}, cell);
    EXPECT_NEAR(glm::distance(inObject(fitted, centre), centreWorld(mesh)), 0.0, 1e-9);
    // The corner of the cell is the corner of the mesh's grid.
    EXPECT_NEAR(
        glm::distance(inObject(fitted, atFraction(cell, glm::dvec3(1.0))), atFraction(mesh, glm::dvec3(1.0))),
        0.0, 1e-9);
    clip.transform.translation = {1.0, 0.0, 0.0}; // half an edge: 5
    clip.transform.scale = glm::dvec3(0.5);
    const ClipObject moved = resolveClipObject(clip, {"m", mesh}, cell);
    EXPECT_NEAR(glm::distance(inObject(moved, centre + glm::dvec3(5.0, 0.0, 0.0)), centreWorld(mesh)), 0.0,
                1e-9);
    EXPECT_NEAR(
        glm::distance(inObject(moved, centre + glm::dvec3(7.5, 2.5, 2.5)), atFraction(mesh, glm::dvec3(1.0))),
        0.0, 1e-9);
}

TEST(ClipResolver, AThresholdOfTheVolumeItselfLandsOnItselfExactly) {
    const Grid grid = obliqueGrid();
    sheet::ClipStyle clip;
    EXPECT_EQ(resolveClipObject(clip, {"t", grid}, grid).objectFromWorld, glm::dmat4(1.0));
    clip.mode = sheet::ClipMode::Probe;
    clip.representation = sheet::ClipRepresentation::Binary;
    const ClipObject object = resolveClipObject(clip, {"t", grid}, grid);
    EXPECT_EQ(object.mode, ClipMode::Probe);
    EXPECT_TRUE(object.binary);
}

TEST(ClipResolver, AScaleThatNoPictureCanHoldIsRefused) {
    sheet::ClipStyle clip;
    clip.transform.scale = {1.0, 1e-200, 1.0};
    try {
        static_cast<void>(resolveClipObject(clip, {"m", {}}, cube(10, 1.0, {0.0, 0.0, 0.0})));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), "clip.transform");
    }
}

} // namespace
} // namespace voxsheet::engine
