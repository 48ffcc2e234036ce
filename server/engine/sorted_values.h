// Many floats in order, faster than by comparing them.
#pragma once

#include <vector>

namespace voxsheet::engine {

/// Drops NaN and infinite values and sorts the others, smallest first; -0 becomes 0.
void sortFinite(std::vector<float>& values);

} // namespace voxsheet::engine
