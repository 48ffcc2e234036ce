#include "stages/occupancy.h"

#include "stages/range_memo.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace voxsheet {
namespace {

/// The bricks that a cell and its surroundings touch on one axis, without repeats.
std::vector<std::vector<int>> bricksOfCells(int cells, int cellSamples, int samples, int bricks,
                                            int brickSamples, bool periodic, int reachSamples) {
    std::vector<std::vector<int>> result(static_cast<std::size_t>(cells));
    for (int cell = 0; cell < cells; ++cell) {
        auto& touched = result[static_cast<std::size_t>(cell)];
        const int begin = cell * cellSamples - reachSamples;
        // One sample beyond the reach, because the look-up point is rounded to a cell in 32-bit floats.
        const int end = (cell + 1) * cellSamples + reachSamples + 1;
        for (int sample = begin - 1; sample < end; ++sample) {
            const int inside =
                periodic ? ((sample % samples) + samples) % samples : std::clamp(sample, 0, samples - 1);
            const int brick = std::min(inside / brickSamples, bricks - 1);
            if (std::find(touched.begin(), touched.end(), brick) == touched.end()) touched.push_back(brick);
        }
    }
    return result;
}

constexpr long kNumbersPerTask = 1L << 16;

std::size_t offset(const glm::ivec3& size, int x, int y, int z) {
    return static_cast<std::size_t>((static_cast<long>(z) * size.y + y) * size.x + x);
}

/// Rows of one axis, in a volume of `size` numbers per axis; whole slices at a time.
void overSlices(const glm::ivec3& size, const std::function<void(int z)>& body) {
    const long slice = std::max(1L, static_cast<long>(size.x) * size.y);
    parallelFor(size.z, std::max(1L, kNumbersPerTask / slice), [&](long begin, long end) {
        for (long z = begin; z < end; ++z)
            body(static_cast<int>(z));
    });
}

template <typename T>
void largestAlongRow(const T* row, const std::vector<std::vector<int>>& touched, T* spread) {
    for (std::size_t x = 0; x < touched.size(); ++x) {
        T largest = row[touched[x].front()];
        for (const int brick : touched[x])
            largest = std::max(largest, row[brick]);
        spread[x] = largest;
    }
}

template <typename T>
void raiseRow(const T* row, int count, T* spread) {
    for (int x = 0; x < count; ++x)
        spread[x] = std::max(spread[x], row[x]);
}

/// Spreads one number per brick to cells: the largest over the bricks that the cell touches, axis by axis.
template <typename T>
std::vector<T> spreadOverCells(std::vector<T> values, glm::ivec3 size, const glm::ivec3& dims,
                               const glm::bvec3& periodic, int reachSamples) {
    const auto layout = CellLayout::of(dims);
    for (int axis = 0; axis < 3; ++axis) {
        const auto touched = bricksOfCells(layout.cells[axis], layout.cellSamples, dims[axis], size[axis],
                                           MinMaxGrid::brickSamplesFor(dims), periodic[axis], reachSamples);
        glm::ivec3 wider = size;
        wider[axis] = layout.cells[axis];
        std::vector<T> spread(static_cast<std::size_t>(wider.x) * static_cast<std::size_t>(wider.y) *
                              static_cast<std::size_t>(wider.z));
        overSlices(wider, [&](int z) {
            for (int y = 0; y < wider.y; ++y) {
                T* out = spread.data() + offset(wider, 0, y, z);
                if (axis == 0) {
                    largestAlongRow(values.data() + offset(size, 0, y, z), touched, out);
                    continue;
                }
                const auto& bricks = touched[static_cast<std::size_t>(axis == 1 ? y : z)];
                const auto rowOf = [&](int brick) {
                    return values.data() +
                           (axis == 1 ? offset(size, 0, brick, z) : offset(size, 0, y, brick));
                };
                std::copy_n(rowOf(bricks.front()), size.x, out);
                for (std::size_t i = 1; i < bricks.size(); ++i)
                    raiseRow(rowOf(bricks[i]), size.x, out);
            }
        });
        values = std::move(spread);
        size = wider;
    }
    return values;
}

/// Answers "is there opacity over [low, high]?" in constant time per question: what maxOpacity asks entry by
/// entry.
class OpacityCounts {
public:
    explicit OpacityCounts(const TransferTable& table) : table_(table), before_(table.entries.size() + 1) {
        for (std::size_t i = 0; i < table.entries.size(); ++i)
            before_[i + 1] = before_[i] + (table.entries[i].w > 0.0F ? 1U : 0U);
    }
    [[nodiscard]] bool any(const MinMaxGrid::Range& range) const {
        if (std::isnan(range.low) || std::isnan(range.high)) return true;
        if (range.low > range.high) return false;
        const double last = static_cast<double>(table_.entries.size() - 1);
        const double from = tablePosition(table_, double(range.low)) * last - 1.0;
        const double to = tablePosition(table_, double(range.high)) * last + 1.0;
        if (from < 0.0 && table_.below.w > 0.0F) return true;
        if (to > last && table_.above.w > 0.0F) return true;
        const auto begin = static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, last));
        const auto end = static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, last));
        return before_[end + 1] > before_[begin];
    }

private:
    const TransferTable& table_;
    std::vector<unsigned> before_;
};

/// Whole cells from a cell to the one `step` further on a row of `count`: the last of the row, where it is
/// short and lies between, does not count.
std::uint8_t cellsApart(int cell, int step, int count, bool shortLast) {
    const bool between = step > 0 ? cell != count - 1 && cell + step >= count : cell + step < -1;
    return static_cast<std::uint8_t>(std::abs(step) - (shortLast && between ? 1 : 0));
}

/// For each cell the smallest over its row of max(steps to it, its distance): axis after axis this gives the
/// Chebyshev distance.
std::vector<std::uint8_t> nearestAlongAxis(const std::vector<std::uint8_t>& distances,
                                           const glm::ivec3& cells, int axis, bool periodic, bool shortLast) {
    auto nearest = distances;
    const int count = cells[axis];
    const int reach = shortLast && periodic ? kFarthestCells : kFarthestCells - 1;
    for (int step = -reach; step <= reach; ++step) {
        if (step == 0 || std::abs(step) > count) continue;
        auto far = static_cast<std::uint8_t>(std::abs(step));
        for (int z = 0; z < cells.z; ++z)
            for (int y = 0; y < cells.y; ++y) {
                glm::ivec3 from(0, y, z);
                int begin = 0;
                int end = cells.x;
                if (axis == 0) {
                    begin = std::max(0, -step);
                    end = std::min(cells.x, cells.x - step);
                } else {
                    far = cellsApart(from[axis], step, count, shortLast);
                    from[axis] += step;
                    if (periodic) from[axis] = ((from[axis] % count) + count) % count;
                    if (from[axis] < 0 || from[axis] >= count) continue;
                }
                const auto* in = distances.data() + offset(cells, 0, from.y, from.z);
                auto* out = nearest.data() + offset(cells, 0, y, z);
                const int shift = axis == 0 ? step : 0;
                for (int x = begin; x < end; ++x)
                    out[x] = std::min(out[x], std::max(in[x + shift], far));
                if (axis != 0 || !periodic) continue;
                for (int x = 0; x < count; ++x)
                    if (x < begin || x >= end)
                        out[x] = std::min(out[x], std::max(in[(((x + step) % count) + count) % count],
                                                           cellsApart(x, step, count, shortLast)));
            }
    }
    return nearest;
}

} // namespace

CellLayout CellLayout::of(const glm::ivec3& dims) {
    CellLayout layout;
    layout.cellSamples = MinMaxGrid::brickSamplesFor(dims);
    layout.cells = (dims + layout.cellSamples - 1) / layout.cellSamples;
    return layout;
}

int shortReach(const glm::ivec3& dims) { return std::min(2, CellLayout::of(dims).cellSamples / 2); }

std::vector<std::uint8_t> occupiedBricks(const MinMaxGrid& grid, const TransferTable& table) {
    const OpacityCounts counts(table);
    RangeMemo<std::uint8_t> memo;
    const auto mark = [&](const MinMaxGrid::Range& range) {
        return counts.any(range) ? std::uint8_t{1} : std::uint8_t{0};
    };
    std::vector<std::uint8_t> bricks(grid.ranges.size());
    std::transform(grid.ranges.begin(), grid.ranges.end(), bricks.begin(),
                   [&](const MinMaxGrid::Range& range) { return memo(range, mark); });
    return bricks;
}

std::vector<std::uint8_t> occupiedCells(const MinMaxGrid& grid, const glm::ivec3& dims,
                                        const glm::bvec3& periodic, const TransferTable& table,
                                        int reachSamples) {
    return largestOverBricks(occupiedBricks(grid, table), grid, dims, periodic, reachSamples);
}

std::vector<std::uint8_t> largestOverBricks(std::vector<std::uint8_t> marks, const MinMaxGrid& grid,
                                            const glm::ivec3& dims, const glm::bvec3& periodic,
                                            int reachSamples) {
    return spreadOverCells(std::move(marks), grid.bricks, dims, periodic, reachSamples);
}

std::vector<std::uint8_t> crossedCells(const MinMaxGrid& grid, const glm::ivec3& dims,
                                       const glm::bvec3& periodic, const std::vector<double>& values,
                                       int reachSamples) {
    // A brick's range bounds every interpolant inside: what is crossed in it lies between its own low and
    // high.
    std::vector<std::uint8_t> bricks(grid.ranges.size());
    std::transform(grid.ranges.begin(), grid.ranges.end(), bricks.begin(),
                   [&](const MinMaxGrid::Range& range) {
                       const bool crossed = std::any_of(values.begin(), values.end(), [&](double value) {
                           return double(range.low) <= value && value <= double(range.high);
                       });
                       return crossed ? std::uint8_t{1} : std::uint8_t{0};
                   });
    return largestOverBricks(std::move(bricks), grid, dims, periodic, reachSamples);
}

std::vector<std::uint8_t> emptyDistances(const std::vector<std::uint8_t>& marks, const glm::ivec3& cells,
                                         const glm::bvec3& periodic, const glm::bvec3& shortLast) {
    std::vector<std::uint8_t> distances(marks.size());
    std::transform(marks.begin(), marks.end(), distances.begin(), [](std::uint8_t mark) {
        return mark != 0 ? std::uint8_t{0} : std::uint8_t{kFarthestCells};
    });
    for (int axis = 0; axis < 3; ++axis)
        distances = nearestAlongAxis(distances, cells, axis, periodic[axis], shortLast[axis]);
    return distances;
}

std::vector<float> largestInCells(const MinMaxGrid& grid, const glm::ivec3& dims, const glm::bvec3& periodic,
                                  float sign, int reachSamples) {
    std::vector<float> bricks(grid.ranges.size());
    std::transform(grid.ranges.begin(), grid.ranges.end(), bricks.begin(),
                   [&](const MinMaxGrid::Range& range) {
                       if (range.low > range.high) return -std::numeric_limits<float>::infinity();
                       return sign > 0.0F ? range.high : -range.low;
                   });
    return spreadOverCells(std::move(bricks), grid.bricks, dims, periodic, reachSamples);
}

} // namespace voxsheet
