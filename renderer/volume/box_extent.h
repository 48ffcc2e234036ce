// How far a volume's drawn box reaches along a direction.
#pragma once

#include "volume/grid.h"

#include <glm/glm.hpp>

namespace voxsheet {

/// Dot products of a direction with the box's first corner along it and with its last.
struct Extent {
    double low = 0.0;
    double high = 0.0;

    [[nodiscard]] double length() const { return high - low; }
};

[[nodiscard]] Extent extentAlong(const glm::dvec3& directionWorld, const Grid& grid);

} // namespace voxsheet
