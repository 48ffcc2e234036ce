// Directions that come in at any length.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace voxsheet::engine {

/// \param v  finite, not zero; however small or large
[[nodiscard]] inline glm::dvec3 unitVector(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return glm::normalize(v / largest);
}

} // namespace voxsheet::engine
