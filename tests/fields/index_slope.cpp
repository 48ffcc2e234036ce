#include "fields/index_slope.h"

#include "fields/trilinear.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace voxsheet::fields {

GradientAt onTheFlySlope(ValueAt value, const glm::ivec3& levelDims, const glm::bvec3& periodic) {
    return [value = std::move(value), dims = glm::dvec3(levelDims), periodic](const glm::dvec3& texture) {
        const auto index = texture * dims - 0.5;
        glm::dvec3 slope(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            auto low = index;
            auto high = index;
            low[axis] -= 1.0;
            high[axis] += 1.0;
            if (!periodic[axis]) {
                low[axis] = std::clamp(low[axis], 0.0, dims[axis] - 1.0);
                high[axis] = std::clamp(high[axis], 0.0, dims[axis] - 1.0);
            }
            const double apart = high[axis] - low[axis];
            if (apart > 0.0) slope[axis] = (value((high + 0.5) / dims) - value((low + 0.5) / dims)) / apart;
        }
        return slope;
    };
}

GradientAt textureSlope(const ValueAt& value, const glm::ivec3& levelDims, const glm::bvec3& periodic) {
    const auto atPoint = onTheFlySlope(value, levelDims, periodic);
    auto slopes = std::make_shared<std::vector<glm::dvec3>>();
    slopes->reserve(static_cast<std::size_t>(sampleCount(levelDims)));
    for (int z = 0; z < levelDims.z; ++z)
        for (int y = 0; y < levelDims.y; ++y)
            for (int x = 0; x < levelDims.x; ++x)
                slopes->push_back(atPoint((glm::dvec3(x, y, z) + 0.5) / glm::dvec3(levelDims)));
    return [slopes, levelDims, periodic](const glm::dvec3& texture) {
        return trilinear(*slopes, levelDims, periodic, texture);
    };
}

glm::dvec3 worldGradient(const Grid& grid, const glm::ivec3& levelDims, const glm::dvec3& indexSlope) {
    // One voxel of the level is 1 / levelDims of the texture frame.
    const auto indexFromWorld = glm::inverse(glm::dmat3(worldFromTexture(grid)));
    return glm::transpose(indexFromWorld) * (indexSlope * glm::dvec3(levelDims));
}

} // namespace voxsheet::fields
