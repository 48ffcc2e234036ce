// A regular grid of samples in the world: positions, box, and the texture frame shared by all levels of
// detail.
//
// Index frame: sample (i, j, k) sits at index position (i, j, k), i the fastest axis in memory.
// World frame: right-handed; worldFromIndex is affine and may be anisotropic, rotated or sheared (crystals).
// Texture frame: t = (p + 1/2) / dims, per axis, for an index position p. It is the same for every level:
// level k has
//   levelDims(k) = ceil(levelDims(k-1) / 2) texels over [0, 1], each the volume-weighted mean of the level
//   below (for even sizes: of 2x2x2 children), so each sits at the mean position of its children, and
//   periodic axes wrap at every level.
#pragma once

#include <glm/glm.hpp>

namespace voxsheet {

enum class Centring {
    Point, ///< the box runs from the first to the last sample
    Cell,  ///< the box reaches half a voxel beyond the first and the last sample
};

struct Grid {
    glm::ivec3 dims{1};           ///< samples per axis at level 0, each >= 1
    glm::dmat4 worldFromIndex{1}; ///< affine, determinant not 0
    Centring centring = Centring::Point;
    glm::bvec3 periodic{
        false}; ///< per axis: wraps, and the box is [0, dims] in the index frame (with the closing slab)

    bool operator==(const Grid&) const = default;
};

struct IndexBox {
    glm::dvec3 low;
    glm::dvec3 high;
};

/// Throws InvalidInput if a dimension is < 1, the product exceeds 2^40, or worldFromIndex is not finite and
/// invertible.
void validateGrid(const Grid& grid);

/// The drawn box in the index frame. An axis with a single sample is one voxel thick.
[[nodiscard]] IndexBox boxIndex(const Grid& grid);

[[nodiscard]] glm::dmat4 textureFromIndex(const Grid& grid);
[[nodiscard]] glm::dmat4 worldFromTexture(const Grid& grid);

/// Centre of the drawn box, in the world.
[[nodiscard]] glm::dvec3 centreWorld(const Grid& grid);
/// Radius of the sphere about centreWorld through the farthest corner of the drawn box.
[[nodiscard]] double boundingRadiusWorld(const Grid& grid);
/// Mean length of the three level-0 voxel edges, in world units: the default of transfer.unitLength.
[[nodiscard]] double meanVoxelEdgeWorld(const Grid& grid);
/// Lengths of the three voxel edges (columns of worldFromIndex).
[[nodiscard]] glm::dvec3 spacingWorld(const Grid& grid);

/// Texels per axis at a level >= 0.
[[nodiscard]] glm::ivec3 levelDims(const glm::ivec3& dims, int level);
/// Number of levels: halves until every axis has at most 16 samples; at least 1.
[[nodiscard]] int levelCount(const glm::ivec3& dims);

[[nodiscard]] inline long sampleCount(const glm::ivec3& dims) {
    return static_cast<long>(dims.x) * dims.y * dims.z;
}

} // namespace voxsheet
