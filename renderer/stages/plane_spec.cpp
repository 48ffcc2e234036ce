#include "stages/plane_spec.h"

#include "base/errors.h"

#include <cmath>

namespace voxsheet {

void validatePlane(const PlaneSpec& plane) {
    if (!(std::abs(glm::length(plane.normal) - 1.0) < 1e-6))
        throw InvalidInput("normal of the plane", "it is not of unit length").withField("plane.normal");
    if (!std::isfinite(plane.offset))
        throw InvalidInput("place of the plane", "it is not finite").withField("plane.position");
}

} // namespace voxsheet
