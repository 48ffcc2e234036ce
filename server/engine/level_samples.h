// One level of one field in memory, to be read along rays.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet::engine {

struct LevelSamples {
    glm::ivec3 dims{1};
    glm::bvec3 periodic{false};
    std::vector<float> values; ///< x fastest

    /// Trilinear at a texture coordinate; NaN if one of the eight is NaN. Beyond the outermost samples they
    /// hold, or the axis wraps.
    [[nodiscard]] float at(const glm::dvec3& texture) const;
    /// Of the nearest sample.
    [[nodiscard]] float nearest(const glm::dvec3& texture) const;

private:
    [[nodiscard]] float sample(glm::ivec3 index) const;
};

} // namespace voxsheet::engine
