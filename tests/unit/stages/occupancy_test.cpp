#include "stages/occupancy.h"

#include "stages/empty_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

namespace voxsheet {
namespace {

/// Opaque for values >= 0.5 only.
std::shared_ptr<const TransferTable> upperHalf() {
    TransferFunction function;
    function.colours = {{0.0, glm::dvec3(1.0)}};
    function.opacities = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {1.0, 0.5}};
    return buildTransferTable(function);
}

/// A level of zeros with one sample of 1, as its min-max grid.
MinMaxGrid gridWithOneSample(const glm::ivec3& dims, const glm::ivec3& sample, const glm::bvec3& periodic) {
    std::vector<float> samples(static_cast<std::size_t>(dims.x * dims.y * dims.z), 0.0F);
    samples[static_cast<std::size_t>((sample.z * dims.y + sample.y) * dims.x + sample.x)] = 1.0F;
    return buildMinMaxGrid({ScalarType::F32, dims, std::as_bytes(std::span(samples))}, periodic);
}

TEST(Occupancy, MarksEverythingWithinReachOfWhatCanBeSeen) {
    std::mt19937 random(11);
    const auto table = upperHalf();
    for (const bool periodic : {false, true}) {
        const glm::ivec3 dims(37, 24, 45);
        for (int trial = 0; trial < 60; ++trial) {
            glm::ivec3 sample(0);
            for (int axis = 0; axis < 3; ++axis)
                sample[axis] = std::uniform_int_distribution<int>(0, dims[axis] - 1)(random);
            const auto layout = CellLayout::of(dims);
            const auto cells = occupiedCells(gridWithOneSample(dims, sample, glm::bvec3(periodic)), dims,
                                             glm::bvec3(periodic), *table, kLongReach);
            ASSERT_EQ(cells.size(),
                      static_cast<std::size_t>(layout.cells.x * layout.cells.y * layout.cells.z));
            // A stretch of a ray up to reachSamples long on either side of a point within one sample of the
            // visible one.
            for (int look = 0; look < 50; ++look) {
                glm::ivec3 cell(0);
                for (int axis = 0; axis < 3; ++axis) {
                    std::uniform_real_distribution<double> around(-kLongReach - 0.99, kLongReach + 0.99);
                    double position = sample[axis] + 0.5 + around(random);
                    if (periodic) position -= dims[axis] * std::floor(position / dims[axis]);
                    cell[axis] = std::clamp(static_cast<int>(position / layout.cellSamples), 0,
                                            layout.cells[axis] - 1);
                }
                EXPECT_EQ(cells[static_cast<std::size_t>((cell.z * layout.cells.y + cell.y) * layout.cells.x +
                                                         cell.x)],
                          1);
            }
        }
    }
}

TEST(Occupancy, LeavesOutWhatIsFarFromAnythingVisible) {
    const glm::ivec3 dims(64);
    const auto cells = occupiedCells(gridWithOneSample(dims, {4, 4, 4}, glm::bvec3(false)), dims,
                                     glm::bvec3(false), *upperHalf(), kLongReach);
    const auto marked = std::count(cells.begin(), cells.end(), std::uint8_t{1});
    EXPECT_GT(marked, 0);
    EXPECT_LT(marked, static_cast<long>(cells.size()) / 8);
    EXPECT_EQ(cells.back(), 0);
}

TEST(Occupancy, AVolumeOfNanIsEmpty) {
    MinMaxGrid grid;
    grid.bricks = glm::ivec3(1);
    const float infinity = std::numeric_limits<float>::infinity();
    grid.ranges = {{infinity, -infinity}};
    const auto cells = occupiedCells(grid, glm::ivec3(8), glm::bvec3(false), *upperHalf(), kLongReach);
    EXPECT_EQ(std::count(cells.begin(), cells.end(), std::uint8_t{0}), static_cast<long>(cells.size()));
    EXPECT_EQ(largestInCells(grid, glm::ivec3(8), glm::bvec3(false), 1.0F, kLongReach).front(), -infinity);
}

TEST(Occupancy, LargestValuesFollowTheSign) {
    const glm::ivec3 dims(64, 8, 8);
    const auto grid = gridWithOneSample(dims, {60, 4, 4}, glm::bvec3(false));
    const auto up = largestInCells(grid, dims, glm::bvec3(false), 1.0F, kLongReach);
    EXPECT_EQ(up.front(), 0.0F);
    EXPECT_EQ(up.back(), 1.0F);
    EXPECT_EQ(largestInCells(grid, dims, glm::bvec3(false), -1.0F, kLongReach).back(), 0.0F);
}

TEST(Occupancy, EmptyDistancesAreThoseToTheNearestMark) {
    std::mt19937 random(5);
    const glm::ivec3 cells(17, 11, 14);
    const auto at = [&](const glm::ivec3& cell) {
        return static_cast<std::size_t>((cell.z * cells.y + cell.y) * cells.x + cell.x);
    };
    for (const bool periodic : {false, true}) {
        std::vector<glm::ivec3> marked;
        std::vector<std::uint8_t> marks(at(cells - 1) + 1, 0);
        for (int i = 0; i < 3; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                marked.resize(static_cast<std::size_t>(i) + 1),
                    marked.back()[axis] = std::uniform_int_distribution<int>(0, cells[axis] - 1)(random);
            marks[at(marked.back())] = 1;
        }
        const auto distances = emptyDistances(marks, cells, glm::bvec3(periodic));
        glm::ivec3 cell(0);
        for (cell.z = 0; cell.z < cells.z; ++cell.z)
            for (cell.y = 0; cell.y < cells.y; ++cell.y)
                for (cell.x = 0; cell.x < cells.x; ++cell.x) {
                    int nearest = kFarthestCells;
                    for (const auto& mark : marked) {
                        auto apart = glm::abs(mark - cell);
                        if (periodic) apart = glm::min(apart, cells - apart);
                        nearest = std::min(nearest, std::max({apart.x, apart.y, apart.z}));
                    }
                    ASSERT_EQ(distances[at(cell)], nearest);
                }
    }
}

TEST(Occupancy, AShortLastCellDoesNotCountWhereItLiesBetween) {
    const glm::ivec3 cells(9, 1, 1);
    std::vector<std::uint8_t> marks(9, 0);
    marks[1] = 1;
    const glm::bvec3 periodic(true, false, false);
    // 7 is 3 steps from the mark by way of 8 and 0, of which 8 is short; 8 itself has only 0 between.
    EXPECT_EQ(emptyDistances(marks, cells, periodic, periodic),
              (std::vector<std::uint8_t>{1, 0, 1, 2, 3, 4, 3, 2, 2}));
    EXPECT_EQ(emptyDistances(marks, cells, periodic), (std::vector<std::uint8_t>{1, 0, 1, 2, 3, 4, 4, 3, 2}));
    // Six steps on, but five whole cells.
    const glm::ivec3 upright(1, 14, 1);
    marks.assign(14, 0);
    marks[0] = 1;
    const glm::bvec3 y(false, true, false);
    EXPECT_EQ(emptyDistances(marks, upright, y, y),
              (std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 6, 5, 4, 3, 2, 1, 1}));
}

TEST(Occupancy, LargeVolumesUseLargerCells) {
    EXPECT_EQ(CellLayout::of(glm::ivec3(64)).cellSamples, 2);
    EXPECT_EQ(shortReach(glm::ivec3(64)), 1);
    EXPECT_EQ(CellLayout::of(glm::ivec3(256)).cellSamples, 4);
    EXPECT_EQ(shortReach(glm::ivec3(256)), 2);
    EXPECT_EQ(CellLayout::of(glm::ivec3(1024)).cellSamples, 4);
    EXPECT_EQ(CellLayout::of(glm::ivec3(2048)).cellSamples, 8);
    EXPECT_EQ(shortReach(glm::ivec3(2048)), 2);
    EXPECT_EQ(CellLayout::of({9, 8, 7}).cells, glm::ivec3(5, 4, 4));
}

TEST(Occupancy, AChunkOfSamplesFitsIntoTwiceTheReach) {
    for (double distance = 0.01; distance < 64.0; distance *= 1.13) {
        const int samples = chunkSamples(distance, kLongReach);
        EXPECT_TRUE(samples == 1 || samples * distance <= 2.0 * kLongReach) << distance;
        EXPECT_LE(samples, 16);
    }
    EXPECT_EQ(chunkSamples(0.5, kLongReach), 16);
    EXPECT_EQ(chunkSamples(0.5, 2), 8);
    EXPECT_EQ(chunkSamples(1.0, kLongReach), 8);
    EXPECT_EQ(chunkSamples(20.0, kLongReach), 1);
}

TEST(Occupancy, CrossedCellsHoldEveryCrossingWithinReach) {
    const glm::ivec3 dims(40, 24, 33);
    const glm::ivec3 sample(21, 9, 17);
    const auto grid = gridWithOneSample(dims, sample, glm::bvec3(false));
    const auto layout = CellLayout::of(dims);
    const auto at = [&](const std::vector<std::uint8_t>& cells, const glm::ivec3& cell) {
        return cells[static_cast<std::size_t>((cell.z * layout.cells.y + cell.y) * layout.cells.x + cell.x)];
    };
    const auto crossed = crossedCells(grid, dims, glm::bvec3(false), {0.5}, kLongReach);
    // The value is passed within one sample of the peak; a cell speaks for its reach around it.
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                EXPECT_EQ(at(crossed, (sample + kLongReach * glm::ivec3(dx, dy, dz)) / layout.cellSamples), 1)
                    << dx << dy << dz;
    EXPECT_EQ(at(crossed, glm::ivec3(0)), 0) << "far away nothing is crossed";
    const auto none = [](const std::vector<std::uint8_t>& cells) {
        return std::all_of(cells.begin(), cells.end(), [](std::uint8_t cell) { return cell == 0; });
    };
    EXPECT_TRUE(none(crossedCells(grid, dims, glm::bvec3(false), {1.5, -0.5}, kLongReach))) << "out of range";
    EXPECT_TRUE(none(crossedCells(grid, dims, glm::bvec3(false), {}, kLongReach)));
    EXPECT_EQ(crossedCells(grid, dims, glm::bvec3(false), {7.0, 0.5}, kLongReach), crossed)
        << "any of the values";
}

} // namespace
} // namespace voxsheet
