// How far apart samples may be: pure, from the min-max grid and the transfer table.
//
// A sample stands for a stretch of h voxels with what the table holds at its middle. Over such a stretch the
// values change by at most their range in the brick, and by about h / 3 of it where they change evenly over
// a brick of 4 samples (in one of 2, which is narrower, h is 5/3 as much). The error of the stretch is
// reckoned as
//     h u (max over the brick's values v of |mean of E over v +- change / 2 - E(v)|
//          + variation of E over the brick's values h / 48  +  light h / 24)
// (widths of means rounded down to powers of 2 entries) with E = extinction times (rgb, 1) as a function of
// values, u unit lengths per voxel; the first term is what bends in the table leave, the second what bends in
// the volume leave between two voxels, the third, of lit volumes, that normals turn (`light` = the largest
// extinction over the brick's values). No bound in the strict sense, since bricks hold ranges and no
// gradients; the pictures are measured.
#pragma once

#include "volume/min_max_grid.h"
#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace voxsheet {

struct StrideSettings {
    double sampleDistanceVoxels = 0.5; ///< of stride 1
    double unitsPerVoxel = 1.0;        ///< world length of a voxel of the drawn level / unitLength
    bool lit = false;
    int brickSamples = 4; ///< of the min-max grid

    bool operator==(const StrideSettings&) const = default;
};

inline constexpr double kLargestStrideError = 1.0 / 512.0; ///< of a stretch's colour or opacity
inline constexpr double kLongestStrideVoxels = 4.0;
inline constexpr int kStrideShift = 4; ///< of the exponent in marks; below it are emptyDistances

/// Of each brick the exponent e of the longest stride, 2^e samples in one, of at most kLongestStrideVoxels,
/// whose error is small enough.
[[nodiscard]] std::vector<std::uint8_t> strideExponents(const MinMaxGrid& grid, const TransferTable& table,
                                                        const StrideSettings& settings);

} // namespace voxsheet
