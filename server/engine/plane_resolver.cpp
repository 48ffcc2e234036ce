#include "engine/plane_resolver.h"

#include "engine/crosshair.h"
#include "engine/unit_vector.h"
#include "volume/box_extent.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::engine {

namespace {

constexpr double kMargin = 1.04;             ///< picture over box, where it fits tightest
constexpr double kFittingDistance = 3.9;     ///< the default of camera.distance
constexpr double kParallelToVertical = 1e-6; ///< sine of the angle

const glm::dvec3 kX(1.0, 0.0, 0.0);
const glm::dvec3 kY(0.0, 1.0, 0.0);
const glm::dvec3 kZ(0.0, 0.0, 1.0);

glm::dvec3 normalOf(const sheet::PlaneStyle& plane) {
    switch (plane.axis) {
    case sheet::PlaneAxis::Axial:
        return kZ;
    case sheet::PlaneAxis::Coronal:
        return kY;
    case sheet::PlaneAxis::Sagittal:
        return kX;
    case sheet::PlaneAxis::Custom:
    case sheet::PlaneAxis::Hkl:
        break;
    }
    return unitVector(plane.normal);
}

PlaneView viewOf(const glm::dvec3& right, const glm::dvec3& up) { return {right, up, glm::cross(right, up)}; }

PlaneView customView(const glm::dvec3& normal) {
    const bool vertical = glm::length(glm::cross(kZ, normal)) < kParallelToVertical;
    const glm::dvec3 right = glm::normalize(glm::cross(vertical ? kY : kZ, normal));
    return viewOf(right, glm::normalize(glm::cross(normal, right)));
}

} // namespace

PlaneView planeView(const sheet::PlaneStyle& plane, bool anatomical) {
    switch (plane.axis) {
    case sheet::PlaneAxis::Axial:
        return viewOf(anatomical ? -kX : kX, kY);
    case sheet::PlaneAxis::Coronal:
        return viewOf(anatomical ? -kX : kX, kZ);
    case sheet::PlaneAxis::Sagittal:
        return viewOf(anatomical ? -kY : kY, kZ);
    case sheet::PlaneAxis::Custom:
    case sheet::PlaneAxis::Hkl:
        break;
    }
    return customView(normalOf(plane));
}

PlaneSpec resolvePlane(const sheet::PlaneStyle& plane, const Grid& grid) {
    PlaneSpec spec;
    spec.normal = normalOf(plane);
    if (const auto crosshair = crosshairWorld(plane, grid)) {
        spec.offset = glm::dot(spec.normal, *crosshair);
    } else {
        const Extent extent = extentAlong(spec.normal, grid);
        spec.offset = extent.low + plane.position * extent.length();
    }
    spec.interpolation = plane.interpolation == sheet::PlaneInterpolation::Nearest
                             ? PlaneInterpolation::Nearest
                             : PlaneInterpolation::Linear;
    return spec;
}

CameraSpec resolvePlaneCamera(const sheet::PlaneStyle& plane, const sheet::CameraStyle& camera,
                              const Grid& grid, bool anatomical, glm::ivec2 sizePixels,
                              const CameraFrame& frame) {
    const PlaneView view = planeView(plane, anatomical);
    const double aspect = static_cast<double>(sizePixels.x) / static_cast<double>(sizePixels.y);
    double fitting =
        std::max(extentAlong(view.up, grid).length(), extentAlong(view.right, grid).length() / aspect);
    if (const auto& size = frame.sizeWorld)
        fitting = std::max({size->x, size->y, size->z}) / std::min(1.0, aspect);
    const double radius = frame.radiusWorld;
    const glm::dvec3 target = frame.centreWorld + camera.targetRadii * radius;
    const glm::dvec3 eye = target + camera.distanceRadii * radius * view.towardsEye;
    const glm::dmat3 viewFromWorldAxes = glm::transpose(glm::dmat3(view.right, view.up, view.towardsEye));

    CameraSpec spec;
    spec.projection = Projection::Orthographic;
    spec.viewFromWorld = glm::dmat4(viewFromWorldAxes);
    spec.viewFromWorld[3] = glm::dvec4(-(viewFromWorldAxes * eye), 1.0);
    spec.heightWorld = kMargin * fitting * camera.distanceRadii / kFittingDistance;
    return spec;
}

} // namespace voxsheet::engine
