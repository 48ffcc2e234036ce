#include "engine/level_samples.h"

#include <algorithm>
#include <cstddef>

namespace voxsheet::engine {

float LevelSamples::sample(glm::ivec3 index) const {
    for (int axis = 0; axis < 3; ++axis) {
        const int size = dims[axis];
        index[axis] =
            periodic[axis] ? ((index[axis] % size) + size) % size : std::clamp(index[axis], 0, size - 1);
    }
    return values[(static_cast<std::size_t>(index.z) * static_cast<std::size_t>(dims.y) +
                   static_cast<std::size_t>(index.y)) *
                      static_cast<std::size_t>(dims.x) +
                  static_cast<std::size_t>(index.x)];
}

float LevelSamples::at(const glm::dvec3& texture) const {
    const glm::dvec3 p = texture * glm::dvec3(dims) - 0.5;
    const glm::dvec3 base = glm::floor(p);
    const glm::dvec3 w = p - base;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, (corner >> 1) & 1, corner >> 2);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            weight *= offset[axis] != 0 ? w[axis] : 1.0 - w[axis];
        if (weight > 0.0) sum += weight * static_cast<double>(sample(glm::ivec3(base) + offset));
    }
    return static_cast<float>(sum);
}

float LevelSamples::nearest(const glm::dvec3& texture) const {
    return sample(glm::ivec3(glm::floor(texture * glm::dvec3(dims))));
}

} // namespace voxsheet::engine
