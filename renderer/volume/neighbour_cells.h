// All pairs of points that lie near each other, found by cells (linked-cell method; Hockney & Eastwood 1981).
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace voxsheet {

/// visit(i, j) with i < j for each pair at most `reach` > 0 apart, in no particular order.
void forEachPairWithin(const std::vector<glm::dvec3>& points, double reach,
                       const std::function<void(std::size_t, std::size_t)>& visit);

} // namespace voxsheet
