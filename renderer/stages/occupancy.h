// Which parts of a volume a transfer function can show: pure, from the min-max grid and the table.
#pragma once

#include "volume/min_max_grid.h"
#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace voxsheet {

/// The level is divided into cells of `cellSamples` samples per axis: cell c covers texture coordinates
/// [c, c + 1) * cellSamples / dims. A mark of a cell speaks for the cell and a reach, in samples, around it
/// (clamped at the ends, or wrapped on periodic axes), so that one look-up in the middle of a stretch of a
/// ray of length <= 2 * reach answers for all of the stretch.
struct CellLayout {
    int cellSamples = 4; ///< as of the bricks of MinMaxGrid
    glm::ivec3 cells{0}; ///< ceil(dims / cellSamples)

    [[nodiscard]] static CellLayout of(const glm::ivec3& dims);
};

/// Where one look-up leads far ahead (emptyDistances): half a cell, 2 at most.
[[nodiscard]] int shortReach(const glm::ivec3& dims);
inline constexpr int kLongReach = 4; ///< where each stretch is looked up

/// Per brick of the grid: 1 where something can have opacity > 0, else 0. Conservative.
[[nodiscard]] std::vector<std::uint8_t> occupiedBricks(const MinMaxGrid& grid, const TransferTable& table);

/// 1 where something within reach can have opacity > 0, else 0; x fastest. Conservative.
[[nodiscard]] std::vector<std::uint8_t> occupiedCells(const MinMaxGrid& grid, const glm::ivec3& dims,
                                                      const glm::bvec3& periodic, const TransferTable& table,
                                                      int reachSamples);

/// Of each cell the largest of the bricks' marks within reach, one mark per brick of the grid; x fastest.
[[nodiscard]] std::vector<std::uint8_t> largestOverBricks(std::vector<std::uint8_t> marks,
                                                          const MinMaxGrid& grid, const glm::ivec3& dims,
                                                          const glm::bvec3& periodic, int reachSamples);

/// 1 where one of `values` may be crossed within reach, else 0; x fastest. Conservative.
[[nodiscard]] std::vector<std::uint8_t> crossedCells(const MinMaxGrid& grid, const glm::ivec3& dims,
                                                     const glm::bvec3& periodic,
                                                     const std::vector<double>& values, int reachSamples);

/// Of each cell to the nearest one with a mark, in cells along the axis on which they lie farthest apart
/// (Chebyshev), wrapped on periodic axes; 0: it has one itself; at most kFarthestCells. Whole cells only:
/// `shortLast` says on which axes the last cell is narrower than the others, and one that lies between does
/// not count.
inline constexpr int kFarthestCells = 6;
[[nodiscard]] std::vector<std::uint8_t> emptyDistances(const std::vector<std::uint8_t>& marks,
                                                       const glm::ivec3& cells, const glm::bvec3& periodic,
                                                       const glm::bvec3& shortLast = glm::bvec3(false));

/// Largest value within reach (sign = 1), or largest negated value (sign = -1); -infinity where all is NaN.
[[nodiscard]] std::vector<float> largestInCells(const MinMaxGrid& grid, const glm::ivec3& dims,
                                                const glm::bvec3& periodic, float sign, int reachSamples);

} // namespace voxsheet
