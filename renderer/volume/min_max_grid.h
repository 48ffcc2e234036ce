// Ranges of the samples that trilinear interpolation can touch, per brick: the basis of empty-space skipping.
#pragma once

#include "volume/stored_array.h"

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet {

/// Brick (bx, by, bz) of a level with `dims` samples covers index positions [8b - 1/2, 8b + 15/2] on each
/// axis, that is texture coordinates [8b / dims, 8(b+1) / dims]; its range is over samples 8b-1 .. 8b+8
/// (clamped, or wrapped on periodic axes), so that it bounds every trilinear interpolant inside. NaN samples
/// are left out; a brick of NaN only has low = +inf, high = -inf.
struct MinMaxGrid {
    static constexpr int brickSamples = 8;

    struct Range {
        float low;
        float high;
    };

    glm::ivec3 bricks{0}; ///< ceil(dims / 8)
    std::vector<Range>
        ranges; ///< bricks.x * bricks.y * bricks.z, x fastest; in values (after slope and intercept)

    [[nodiscard]] static glm::ivec3 bricksFor(const glm::ivec3& dims) { return (dims + 7) / 8; }
};

/// The grid of one level. Ranges are of values; where a value has no float they are widened outwards, so that
/// they still bound it. Infinite samples count (low or high is then infinite). Throws InvalidInput as
/// validateStoredArray.
[[nodiscard]] MinMaxGrid buildMinMaxGrid(const StoredArray& level, const glm::bvec3& periodic);

} // namespace voxsheet
