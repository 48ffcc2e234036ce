// Ranges of the samples that trilinear interpolation can touch, per brick: the basis of empty-space skipping.
#pragma once

#include "volume/stored_array.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace voxsheet {

/// With s = brickSamplesFor(dims), brick (bx, by, bz) of a level covers index positions [s b - 1/2, s b + s -
/// 1/2] on each axis, that is texture coordinates [s b / dims, s (b + 1) / dims]; its range is over samples
/// s b - 1 .. s b + s (clamped, or wrapped on periodic axes), so that it bounds every trilinear interpolant
/// inside. NaN samples are left out; a brick of NaN only has low = +inf, high = -inf.
struct MinMaxGrid {
    /// 4; 8 where that would be more than 2^24 bricks (128 MiB); 2 in volumes of at most 2^20 samples, which
    /// have few voxels between their details. Smaller bricks lead rays closer to what is there: with bricks
    /// of 4 isosurfaces of 256^3 take 12 samples per ray instead of 16.
    [[nodiscard]] static int brickSamplesFor(const glm::ivec3& dims);

    struct Range {
        float low;
        float high;
    };

    glm::ivec3 bricks{0}; ///< ceil(dims / s)
    std::vector<Range>
        ranges; ///< bricks.x * bricks.y * bricks.z, x fastest; in values (after slope and intercept)

    [[nodiscard]] static glm::ivec3 bricksFor(const glm::ivec3& dims) {
        const int samples = brickSamplesFor(dims);
        return (dims + samples - 1) / samples;
    }
};

/// Of bricks and ranges: equal for equal grids, and only by chance (1 in 2^64) for others.
[[nodiscard]] std::uint64_t contentHash(const MinMaxGrid& grid);

/// The grid of one level. Ranges are of values; where a value has no float they are widened outwards, so that
/// they still bound it. Infinite samples count (low or high is then infinite). Throws InvalidInput as
/// validateStoredArray.
[[nodiscard]] MinMaxGrid buildMinMaxGrid(const StoredArray& level, const glm::bvec3& periodic);

} // namespace voxsheet
