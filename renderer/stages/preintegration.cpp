#include "stages/preintegration.h"

#include "stages/classification.h"

#include <algorithm>

namespace voxsheet {

std::vector<glm::vec4> integralTable(const TransferTable& table) {
    const auto entries = shaderTable(table);
    std::vector<glm::vec4> integrals{glm::vec4(0.0F)};
    integrals.reserve(entries.size() + 1);
    glm::dvec4 sum(0.0);
    for (const auto& entry : entries) {
        const double extinction = std::min<double>(entry.w, kLargestMeanExtinction);
        sum += extinction * glm::dvec4(glm::dvec3(entry), 1.0);
        integrals.emplace_back(sum);
    }
    return integrals;
}

} // namespace voxsheet
