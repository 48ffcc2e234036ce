#include "sheet/camera.h"

#include <cmath>

namespace voxsheet::sheet {

CameraPose cameraPose(const CameraStyle& camera, const glm::dvec3& centreWorld, double radiusWorld) {
    const double azimuth = glm::radians(std::fmod(camera.azimuthDegrees, 360.0));
    const double elevation = glm::radians(camera.elevationDegrees);
    const double roll = glm::radians(std::fmod(camera.rollDegrees, 360.0));
    const glm::dvec3 toEye{std::cos(elevation) * std::sin(azimuth), -std::cos(elevation) * std::cos(azimuth),
                           std::sin(elevation)};
    // The derivative of toEye by elevation: well defined at the poles too, where z is no up vector.
    const glm::dvec3 upright{-std::sin(elevation) * std::sin(azimuth),
                             std::sin(elevation) * std::cos(azimuth), std::cos(elevation)};
    const glm::dvec3 right = glm::cross(upright, toEye);
    const double distance = camera.distanceRadii * radiusWorld;

    CameraPose pose;
    pose.targetWorld = centreWorld + camera.targetRadii * radiusWorld;
    pose.eyeWorld = pose.targetWorld + toEye * distance;
    pose.upWorld = upright * std::cos(roll) + right * std::sin(roll);
    const glm::dvec3 viewRight = glm::cross(pose.upWorld, toEye);
    const glm::dmat3 viewFromWorldAxes = glm::transpose(glm::dmat3(viewRight, pose.upWorld, toEye));
    pose.viewFromWorld = glm::dmat4(viewFromWorldAxes);
    pose.viewFromWorld[3] = glm::dvec4(-(viewFromWorldAxes * pose.eyeWorld), 1.0);
    pose.orthographicHeightWorld = 2.0 * distance * std::tan(glm::radians(camera.fovDegrees) / 2.0);
    return pose;
}

} // namespace voxsheet::sheet
