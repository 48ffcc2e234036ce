// Letters of the patient's sides on finished pictures.
#include "engine/orientation_marks.h"

#include "engine/plane_resolver.h"
#include "sheet/camera.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

std::string aroundOf(const glm::dmat3& viewFromWorld) {
    std::string around;
    for (const glm::dvec2 edge : {glm::dvec2(-1, 0), {1, 0}, {0, 1}, {0, -1}})
        around += (around.empty() ? "" : " ") + edgeLetters(viewFromWorld, edge);
    return around;
}

/// Of a picture that shows these directions of the world to the right and upwards.
glm::dmat3 viewOf(const glm::dvec3& right, const glm::dvec3& up) {
    return glm::transpose(glm::dmat3(right, up, glm::cross(right, up)));
}

TEST(OrientationMarks, PlanesOfPatientsFollowTheRadiologicalConvention) {
    for (const auto& [axis, letters] : {std::pair{sheet::PlaneAxis::Axial, "R L A P"},
                                        {sheet::PlaneAxis::Coronal, "R L S I"},
                                        {sheet::PlaneAxis::Sagittal, "A P S I"}}) {
        sheet::PlaneStyle plane;
        plane.axis = axis;
        const PlaneView view = planeView(plane, true);
        EXPECT_EQ(aroundOf(viewOf(view.right, view.up)), letters);
    }
}

TEST(OrientationMarks, ObliqueViewsNameTwoSidesTheNearerFirst) {
    sheet::CameraStyle camera;
    camera.azimuthDegrees = 30.0; // from behind the patient, then to the right
    const auto view = glm::dmat3(sheet::cameraPose(camera, glm::dvec3(0.0), 1.0).viewFromWorld);
    EXPECT_EQ(aroundOf(view), "LP RA S I");
    camera.azimuthDegrees = 10.0;
    EXPECT_EQ(aroundOf(glm::dmat3(sheet::cameraPose(camera, glm::dvec3(0.0), 1.0).viewFromWorld)), "L R S I");
}

} // namespace
} // namespace voxsheet::engine
