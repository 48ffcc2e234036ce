#include "stages/gradient_frame.h"

#include <algorithm>

namespace voxsheet {

glm::dmat3 viewFromVoxels(const glm::dmat4& viewFromWorld, const Grid& grid, const glm::ivec3& levelSamples) {
    auto edges = glm::dmat3(viewFromWorld) * glm::dmat3(worldFromTexture(grid));
    for (int axis = 0; axis < 3; ++axis)
        edges[axis] /= static_cast<double>(levelSamples[axis]);
    return edges;
}

glm::mat3 viewFromGradient(const glm::dmat3& voxelsInView) {
    const auto matrix = glm::transpose(glm::inverse(voxelsInView));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        largest = std::max(largest, glm::length(matrix[column]));
    return glm::mat3(matrix / largest);
}

} // namespace voxsheet
