#include "stages/gradient_frame.h"

#include <algorithm>

namespace voxsheet {

glm::mat3 viewFromGradient(const glm::dmat3& viewFromVoxels) {
    const auto matrix = glm::transpose(glm::inverse(viewFromVoxels));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        largest = std::max(largest, glm::length(matrix[column]));
    return glm::mat3(matrix / largest);
}

} // namespace voxsheet
