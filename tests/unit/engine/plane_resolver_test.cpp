#include "engine/plane_resolver.h"

#include "engine/cell_resolver.h"
#include "engine/kept_ray.h"
#include "memory_dataset.h"
#include "volume/box_extent.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxsheet::engine {
namespace {

using sheet::PlaneAxis;

DatasetMeta patient(bool anatomical = true) {
    DatasetMeta meta = test::metaOf("k", {20, 40, 10});
    meta.grid.worldFromIndex[2][2] = 5.0;
    meta.grid.worldFromIndex[3] = glm::dvec4(100.0, -30.0, 7.0, 1.0);
    meta.anatomical = anatomical;
    return meta;
}

sheet::PlaneStyle planeOf(PlaneAxis axis, const glm::dvec3& normal = glm::dvec3(0.0, 0.0, 1.0)) {
    sheet::PlaneStyle plane;
    plane.axis = axis;
    plane.normal = normal;
    return plane;
}

sheet::CameraStyle defaultCamera() {
    sheet::CameraStyle camera;
    camera.distanceRadii = 3.9;
    return camera;
}

/// Where a step along a world direction goes in the picture: right, up, towards the eye.
glm::dvec3 inPicture(PlaneAxis axis, bool anatomical, const glm::dvec3& direction) {
    const auto camera = resolvePlaneCamera(planeOf(axis), defaultCamera(), patient(anatomical).grid,
                                           anatomical, {80, 60}, ownFrame(patient(anatomical).grid));
    return glm::dmat3(camera.viewFromWorld) * direction;
}

TEST(PlaneResolver, PatientsAreShownAsRadiologistsDo) {
    const glm::dvec3 right(1, 0, 0);
    const glm::dvec3 anterior(0, 1, 0);
    const glm::dvec3 superior(0, 0, 1);
    EXPECT_EQ(inPicture(PlaneAxis::Axial, true, right), glm::dvec3(-1, 0, 0)) << "their right on the left";
    EXPECT_EQ(inPicture(PlaneAxis::Axial, true, anterior), glm::dvec3(0, 1, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Axial, true, superior), glm::dvec3(0, 0, -1)) << "from the feet";
    EXPECT_EQ(inPicture(PlaneAxis::Coronal, true, right), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Coronal, true, superior), glm::dvec3(0, 1, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Coronal, true, anterior), glm::dvec3(0, 0, 1)) << "from the front";
    EXPECT_EQ(inPicture(PlaneAxis::Sagittal, true, anterior), glm::dvec3(-1, 0, 0)) << "facing left";
    EXPECT_EQ(inPicture(PlaneAxis::Sagittal, true, superior), glm::dvec3(0, 1, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Sagittal, true, right), glm::dvec3(0, 0, -1)) << "from their left";
}

TEST(PlaneResolver, OtherDataHaveTheirAxesToTheRightAndUp) {
    const glm::dvec3 x(1, 0, 0);
    const glm::dvec3 y(0, 1, 0);
    const glm::dvec3 z(0, 0, 1);
    EXPECT_EQ(inPicture(PlaneAxis::Axial, false, x), glm::dvec3(1, 0, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Axial, false, y), glm::dvec3(0, 1, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Coronal, false, x), glm::dvec3(1, 0, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Coronal, false, z), glm::dvec3(0, 1, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Sagittal, false, y), glm::dvec3(1, 0, 0));
    EXPECT_EQ(inPicture(PlaneAxis::Sagittal, false, z), glm::dvec3(0, 1, 0));
}

TEST(PlaneResolver, CustomPlanesFaceTheEyeWithTheVerticalUp) {
    for (const glm::dvec3 normal : {glm::dvec3(1, 2, 3), glm::dvec3(-4, 0, 0), glm::dvec3(0, 0, 2),
                                    glm::dvec3(0, 0, -1e-200), glm::dvec3(1e-9, 0, 1)}) {
        const PlaneView view = planeView(planeOf(PlaneAxis::Custom, normal), true);
        const glm::dvec3 unit =
            normal / std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
        EXPECT_NEAR(glm::dot(view.towardsEye, glm::normalize(unit)), 1.0, 1e-12);
        EXPECT_NEAR(glm::length(glm::cross(view.right, view.up) - view.towardsEye), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(view.up), 1.0, 1e-12);
        const bool vertical = std::abs(unit.z) == 1.0 && std::abs(unit.x) < 1e-6;
        EXPECT_NEAR(vertical ? view.up.x : view.right.z, 0.0, 1e-8) << "the picture does not lean";
        EXPECT_GT(vertical ? view.up.y : view.up.z, 0.0);
    }
}

TEST(PlaneResolver, PositionRunsThroughTheDrawnBoxAlongTheNormal) {
    const DatasetMeta meta = patient();
    auto plane = planeOf(PlaneAxis::Axial);
    plane.position = 0.0;
    EXPECT_NEAR(resolvePlane(plane, meta.grid).offset, 7.0, 1e-12);
    plane.position = 1.0;
    EXPECT_NEAR(resolvePlane(plane, meta.grid).offset, 7.0 + 9 * 5.0, 1e-12);
    plane.axis = PlaneAxis::Sagittal;
    plane.position = 0.5;
    EXPECT_NEAR(resolvePlane(plane, meta.grid).offset, 100.0 + 9.5, 1e-12);
    EXPECT_EQ(resolvePlane(plane, meta.grid).normal, glm::dvec3(1, 0, 0));
    plane = planeOf(PlaneAxis::Custom, {0.0, 3.0, 3.0});
    EXPECT_NEAR(resolvePlane(plane, meta.grid).offset,
                glm::dot(glm::dvec3(0.0, std::sqrt(0.5), std::sqrt(0.5)), centreWorld(meta.grid)), 1e-9);
    plane.interpolation = sheet::PlaneInterpolation::Nearest;
    EXPECT_EQ(resolvePlane(plane, meta.grid).interpolation, PlaneInterpolation::Nearest);
}

TEST(PlaneResolver, TheBoxFitsThePictureAndDistanceZooms) {
    const DatasetMeta meta = patient();
    for (const auto axis : {PlaneAxis::Axial, PlaneAxis::Coronal, PlaneAxis::Sagittal, PlaneAxis::Custom})
        for (const glm::ivec2 size : {glm::ivec2(80, 60), glm::ivec2(40, 400), glm::ivec2(500, 50)}) {
            const auto plane = planeOf(axis, {1.0, 2.0, -1.0});
            auto style = defaultCamera();
            const auto camera =
                resolvePlaneCamera(plane, style, meta.grid, meta.anatomical, size, ownFrame(meta.grid));
            EXPECT_EQ(camera.projection, Projection::Orthographic);
            const PlaneView view = planeView(plane, meta.anatomical);
            const double width = camera.heightWorld * size.x / size.y;
            const double tight = std::max(extentAlong(view.right, meta.grid).length() / width,
                                          extentAlong(view.up, meta.grid).length() / camera.heightWorld);
            EXPECT_GT(tight, 0.9);
            EXPECT_LT(tight, 1.0);
            style.distanceRadii /= 2.0;
            style.azimuthDegrees = 77.0;
            style.elevationDegrees = -20.0;
            style.rollDegrees = 12.0;
            style.projection = sheet::Projection::Perspective;
            const auto nearer =
                resolvePlaneCamera(plane, style, meta.grid, meta.anatomical, size, ownFrame(meta.grid));
            EXPECT_NEAR(nearer.heightWorld, camera.heightWorld / 2.0, 1e-9);
            EXPECT_EQ(glm::dmat3(nearer.viewFromWorld), glm::dmat3(camera.viewFromWorld));
        }
}

TEST(PlaneResolver, TheTargetIsInTheMiddleOfThePicture) {
    const DatasetMeta meta = patient();
    auto style = defaultCamera();
    style.targetRadii = {0.1, -0.2, 0.3};
    const auto camera = resolvePlaneCamera(planeOf(PlaneAxis::Coronal), style, meta.grid, meta.anatomical,
                                           {80, 60}, ownFrame(meta.grid));
    const glm::dvec3 target = centreWorld(meta.grid) + style.targetRadii * boundingRadiusWorld(meta.grid);
    const Ray ray = pixelRay(camera, {40.0, 30.0}, {80, 60});
    EXPECT_NEAR(ray.origin.x, target.x, 1e-9);
    EXPECT_NEAR(ray.origin.z, target.z, 1e-9);
    EXPECT_EQ(ray.direction, glm::dvec3(0, -1, 0));
}

TEST(PlaneResolver, OnlyTheTechniqueMakesATileFlatAndNothingClipsIt) {
    const DatasetMeta meta = patient();
    sheet::TypedStyle style;
    style.camera = defaultCamera();
    style.camera.projection = sheet::Projection::Perspective;
    style.clip.planes = {{{1.0, 0.0, 0.0}, 0.5}};
    style.plane.axis = PlaneAxis::Sagittal;
    style.plane.position = 0.25;
    const auto tile = [&] { return resolveTile(style, meta, {0, 0}, nullptr, {64, 64}, 0, 1.0); };
    EXPECT_EQ(tile().clip.planes.size(), 1U);
    EXPECT_EQ(tile().camera.projection, Projection::Perspective);
    style.technique = sheet::Technique::Plane;
    EXPECT_EQ(tile().technique, Technique::Plane);
    EXPECT_TRUE(tile().clip.planes.empty());
    EXPECT_EQ(tile().camera.projection, Projection::Orthographic);
    EXPECT_NEAR(tile().plane.offset, 100.0 + 0.25 * 19.0, 1e-12);
}

} // namespace
} // namespace voxsheet::engine
