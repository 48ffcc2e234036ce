#include "volume/box_extent.h"

#include <algorithm>
#include <limits>

namespace voxsheet {

namespace {

glm::dvec3 cornerWorld(const Grid& grid, const IndexBox& box, int corner) {
    const glm::dvec3 index((corner & 1) != 0 ? box.high.x : box.low.x,
                           (corner & 2) != 0 ? box.high.y : box.low.y,
                           (corner & 4) != 0 ? box.high.z : box.low.z);
    return glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0));
}

} // namespace

Extent extentAlong(const glm::dvec3& directionWorld, const Grid& grid) {
    const IndexBox box = boxIndex(grid);
    Extent extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (int corner = 0; corner < 8; ++corner) {
        const double at = glm::dot(directionWorld, cornerWorld(grid, box, corner));
        extent.low = std::min(extent.low, at);
        extent.high = std::max(extent.high, at);
    }
    return extent;
}

} // namespace voxsheet
