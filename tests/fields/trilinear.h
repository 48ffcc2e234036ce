// Trilinear interpolation of samples in double precision.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace voxsheet::fields {

/// Between texel centres (i + 1/2) / dims; wraps on periodic axes, else clamps to the first and last sample.
/// A sample of weight 0 does not count, whatever it is.
template <typename T>
[[nodiscard]] T trilinear(const std::vector<T>& samples, const glm::ivec3& dims, const glm::bvec3& periodic,
                          const glm::dvec3& texture) {
    const auto index = texture * glm::dvec3(dims) - 0.5;
    const auto base = glm::floor(index);
    const auto weight = index - base;
    const auto inside = [&](int axis, double position) {
        const int n = dims[axis];
        const int i = static_cast<int>(position);
        return periodic[axis] ? ((i % n) + n) % n : std::clamp(i, 0, n - 1);
    };
    T sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        double product = 1.0;
        glm::ivec3 sample(0);
        for (int axis = 0; axis < 3; ++axis) {
            const int step = (corner >> axis) & 1;
            product *= step != 0 ? weight[axis] : 1.0 - weight[axis];
            sample[axis] = inside(axis, base[axis] + step);
        }
        if (product == 0.0) continue;
        sum += product * samples[static_cast<std::size_t>(
                             (static_cast<long>(sample.z) * dims.y + sample.y) * dims.x + sample.x)];
    }
    return sum;
}

} // namespace voxsheet::fields
