// The solid where a volume is above or below a threshold, as a volume of signed distances: a clip object made
// of data.
//
// The solid is the set of points of the drawn box at which the trilinear interpolant satisfies the
// comparison: closed at the faces of the box, and absent where a sample that the interpolant touches is NaN
// (so NaN samples are outside). Distances are Euclidean, negative inside (Lorensen 1993), in world units.
//
// Method: the solid is sampled on the output grid; its surface is a net of quadrilaterals with one vertex in
// each cell that it passes through, the mean of the crossings on the cell's edges (surface nets: Gibson
// 1998), each found by bisection of the interpolant to 1/1000 of an edge. Distances to the net are exact
// within one output voxel of it. Further away, the exact Euclidean distance transform of Felzenszwalb &
// Huttenlocher (Theory of Computing 8, 2012) names a cell to start from, and distances are to the
// quadrilaterals about the nearest vertex near there.
#pragma once

#include "volume/grid.h"

#include <span>
#include <vector>

namespace voxsheet {

enum class Comparison {
    Greater,        ///< value > threshold is inside
    GreaterOrEqual, ///< value >= threshold
    Less,           ///< value < threshold
    LessOrEqual     ///< value <= threshold
};

struct Threshold {
    Comparison comparison = Comparison::Greater;
    double value = 0.0;
};

struct DistanceVolume {
    Grid grid;                    ///< point-centred, isotropic, its axes those of the world, not periodic
    std::vector<float> distances; ///< world units, one per sample of the grid, x fastest; finite
};

/// Samples on each side between the drawn box and the border of the distances' grid: all of them outside.
inline constexpr int kDistanceMarginSamples = 3;
inline constexpr long kMaxDistanceSamples = 4'000'000;

/// The output grid that signedDistance uses. Its spacing is the field's shortest voxel edge, or as much more
/// as `maxSamples` asks for; a face of the box at the low end of an axis falls on samples, and so does the
/// opposite one if the box is a whole number of spacings long. Throws InvalidInput as validateGrid, or if
/// maxSamples < 1000.
[[nodiscard]] Grid distanceGrid(const Grid& field, long maxSamples = kMaxDistanceSamples);

/// \param field   geometry of the volume: any affine, also sheared; periodic axes wrap
/// \param values  its level 0, x fastest; NaN is no value
///
/// Where the surface has radii of curvature of R output voxels or more, distances and the zero level of their
/// own interpolant are within 0.7 / R voxels of the solid's surface (measured on balls and tori:
/// signed_distance_test.cpp); at its sharp edges, such as those of the box that do not fall on samples,
/// within 0.5. Between neighbouring samples |d(p) - d(q)| <= |p - q| up to rounding, so that the gradient of
/// the trilinear interpolant is at most sqrt(3). What is thinner than an output voxel may be lost. With
/// nothing inside, every distance is the diagonal of the output grid. Takes a second for 4 million samples on
/// two cores, some for noise.
///
/// Throws InvalidInput as distanceGrid, or if there are not as many values as samples or the threshold is
/// NaN.
[[nodiscard]] DistanceVolume signedDistance(const Grid& field, std::span<const float> values,
                                            const Threshold& threshold,
                                            long maxSamples = kMaxDistanceSamples);

} // namespace voxsheet
