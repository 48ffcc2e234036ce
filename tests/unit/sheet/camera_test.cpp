#include "sheet/camera.h"

#include <gtest/gtest.h>

#include <random>

namespace voxsheet::sheet {
namespace {

constexpr double kTolerance = 1e-12;

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z;
}

CameraStyle camera(double azimuth, double elevation, double roll = 0.0) {
    CameraStyle style;
    style.azimuthDegrees = azimuth;
    style.elevationDegrees = elevation;
    style.rollDegrees = roll;
    style.distanceRadii = 4.0;
    return style;
}

TEST(Camera, AxesAsDocumented) {
    const glm::dvec3 centre(1, 2, 3);
    expectNear(cameraPose(camera(0, 0), centre, 0.5).eyeWorld, centre + glm::dvec3(0, -2, 0));
    expectNear(cameraPose(camera(90, 0), centre, 0.5).eyeWorld, centre + glm::dvec3(2, 0, 0));
    expectNear(cameraPose(camera(0, 90), centre, 0.5).eyeWorld, centre + glm::dvec3(0, 0, 2));
    expectNear(cameraPose(camera(0, 0), centre, 0.5).upWorld, {0, 0, 1});
    expectNear(cameraPose(camera(0, 90), centre, 0.5).upWorld, {0, 1, 0});
    // Looking along +y, x is to the right and z up.
    const glm::dmat4 view = cameraPose(camera(0, 0), centre, 0.5).viewFromWorld;
    expectNear(glm::dvec3(view * glm::dvec4(1, 0, 0, 0)), {1, 0, 0});
    expectNear(glm::dvec3(view * glm::dvec4(0, 0, 1, 0)), {0, 1, 0});
}

TEST(Camera, RollTurnsTheEyeClockwise) {
    // The eye turned by 90 degrees to the right: its up is what was its right.
    expectNear(cameraPose(camera(0, 0, 90), glm::dvec3(0), 1).upWorld, {1, 0, 0});
}

TEST(Camera, ViewIsRigidAndLooksAtTheTarget) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(-400, 400);
    std::uniform_real_distribution<double> height(-90, 90);
    for (int i = 0; i < 200; ++i) {
        CameraStyle style = camera(angle(random), height(random), angle(random));
        style.targetRadii = {0.1, -0.2, 0.3};
        const CameraPose pose = cameraPose(style, {5, 6, 7}, 2.0);
        expectNear(pose.targetWorld, glm::dvec3(5, 6, 7) + 2.0 * style.targetRadii);
        const glm::dmat3 axes(pose.viewFromWorld);
        EXPECT_NEAR(glm::determinant(axes), 1.0, kTolerance);
        const glm::dmat3 product = axes * glm::transpose(axes);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(product[k][k], 1.0, kTolerance);
        expectNear(glm::dvec3(pose.viewFromWorld * glm::dvec4(pose.eyeWorld, 1)), {0, 0, 0});
        expectNear(glm::dvec3(pose.viewFromWorld * glm::dvec4(pose.targetWorld, 1)), {0, 0, -8});
    }
}

TEST(Camera, OrthographicShowsWhatPerspectiveShowsAtTheTarget) {
    CameraStyle style = camera(0, 0);
    style.fovDegrees = 90.0;
    EXPECT_NEAR(cameraPose(style, glm::dvec3(0), 3.0).orthographicHeightWorld, 2.0 * 12.0, 1e-9);
}

} // namespace
} // namespace voxsheet::sheet
