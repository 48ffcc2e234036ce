#include "import/formats/geometry.h"

#include "base/errors.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::import {

glm::dmat4 affine(const AxisColumns& columns, const glm::dvec3& origin) {
    return {glm::dvec4(columns[0], 0.0), glm::dvec4(columns[1], 0.0), glm::dvec4(columns[2], 0.0),
            glm::dvec4(origin, 1.0)};
}

glm::dmat4 rasFromLps() { return glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, -1.0, 1.0)); }

void completeAxes(AxisColumns& columns, int count) {
    if (count == 1) {
        const auto& first = columns[0];
        // The world axis that is farthest from the first column is never parallel to it.
        const auto size = glm::abs(first);
        const glm::dvec3 helper = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                                  : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                       : glm::dvec3(0, 0, 1);
        columns[1] = glm::normalize(glm::cross(glm::cross(first, helper), first)) * glm::length(first);
    }
    if (count < 3) {
        const auto length = 0.5 * (glm::length(columns[0]) + glm::length(columns[1]));
        columns[2] = glm::normalize(glm::cross(columns[0], columns[1])) * length;
    }
}

void checkSpacing(const std::string& what, const std::vector<double>& spacing) {
    for (const double length : spacing)
        if (!std::isfinite(length) || length == 0.0)
            throw InvalidInput(what, "the spacing " + std::to_string(length) + " is not possible",
                               "correct the spacing in the header");
}

void checkSpanSpace(const std::string& what, const char* vectors, const AxisColumns& columns) {
    const double volume = std::abs(glm::determinant(glm::dmat3(columns[0], columns[1], columns[2])));
    const double box = glm::length(columns[0]) * glm::length(columns[1]) * glm::length(columns[2]);
    if (!std::isfinite(box) || !(volume > 1e-9 * box)) // as validateGrid
        throw InvalidInput(
            what, std::string("its ") + vectors + " do not span space (one is zero, or they lie in a plane)",
            "correct them in the file");
}

} // namespace voxsheet::import
