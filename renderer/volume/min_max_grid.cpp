#include "volume/min_max_grid.h"

#include "volume/grid.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

namespace voxsheet {

namespace {

constexpr long kMaxSmallBricks = 1L << 24;
constexpr long kSmallVolumeSamples = 1L << 20;

/// The samples that trilinear interpolation inside brick `b` can touch: one more on both sides, clamped or
/// wrapped.
std::vector<int> touchedSamples(int b, int brickSamples, int n, bool periodic) {
    std::vector<int> samples;
    for (int i = brickSamples * b - 1; i <= brickSamples * (b + 1); ++i) {
        if (i >= 0 && i < n)
            samples.push_back(i);
        else if (periodic)
            samples.push_back(((i % n) + n) % n);
    }
    return samples;
}

std::vector<std::vector<int>> touchedPerBrick(int brickSamples, int n, bool periodic) {
    std::vector<std::vector<int>> all;
    for (int b = 0; b * brickSamples < n; ++b)
        all.push_back(touchedSamples(b, brickSamples, n, periodic));
    return all;
}

template <typename T>
struct Bounds {
    // Start beyond every value, so that a brick of NaN only is recognised by low > high.
    static constexpr T high =
        std::is_floating_point_v<T> ? std::numeric_limits<T>::infinity() : std::numeric_limits<T>::max();
    static constexpr T low =
        std::is_floating_point_v<T> ? -std::numeric_limits<T>::infinity() : std::numeric_limits<T>::lowest();
};

float floatBelow(double value) {
    const auto rounded = static_cast<float>(value);
    if (static_cast<double>(rounded) <= value || std::isnan(value)) return rounded;
    return std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

float floatAbove(double value) { return -floatBelow(-value); }

template <typename T>
MinMaxGrid::Range valueRange(T low, T high, double scale, double offset) {
    if (low > high) return {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    double a = scale * static_cast<double>(low) + offset;
    double b = scale * static_cast<double>(high) + offset;
    if (a > b) std::swap(a, b);
    return {floatBelow(a), floatAbove(b)};
}

template <typename T>
void buildRanges(const StoredArray& level, const glm::bvec3& periodic, MinMaxGrid& grid) {
    const auto* in = reinterpret_cast<const T*>(level.samples.data());
    const int brickSamples = MinMaxGrid::brickSamplesFor(level.dims);
    const auto touchedX = touchedPerBrick(brickSamples, level.dims.x, periodic.x);
    const auto touchedY = touchedPerBrick(brickSamples, level.dims.y, periodic.y);
    const auto touchedZ = touchedPerBrick(brickSamples, level.dims.z, periodic.z);
    const auto rowLength = static_cast<std::size_t>(level.dims.x);

    // One row of bricks at a time: the sample rows that it touches fold into one row of ranges, which
    // then folds along x.
    parallelFor(static_cast<long>(touchedZ.size() * touchedY.size()), 8, [&](long begin, long end) {
        std::vector<T> lows(rowLength);
        std::vector<T> highs(rowLength);
        for (auto brickRow = static_cast<std::size_t>(begin); brickRow < static_cast<std::size_t>(end);
             ++brickRow) {
            std::fill(lows.begin(), lows.end(), Bounds<T>::high);
            std::fill(highs.begin(), highs.end(), Bounds<T>::low);
            for (const int z : touchedZ[brickRow / touchedY.size()])
                for (const int y : touchedY[brickRow % touchedY.size()]) {
                    const T* row =
                        in + (static_cast<std::size_t>(z) * static_cast<std::size_t>(level.dims.y) +
                              static_cast<std::size_t>(y)) *
                                 rowLength;
                    for (std::size_t i = 0; i < rowLength; ++i) {
                        lows[i] = row[i] < lows[i] ? row[i] : lows[i]; // false for NaN
                        highs[i] = row[i] > highs[i] ? row[i] : highs[i];
                    }
                }
            for (std::size_t b = 0; b < touchedX.size(); ++b) {
                T low = Bounds<T>::high;
                T high = Bounds<T>::low;
                for (const int x : touchedX[b]) {
                    low = std::min(low, lows[static_cast<std::size_t>(x)]);
                    high = std::max(high, highs[static_cast<std::size_t>(x)]);
                }
                grid.ranges[brickRow * touchedX.size() + b] =
                    valueRange(low, high, level.valueScale, level.valueOffset);
            }
        }
    });
}

} // namespace

int MinMaxGrid::brickSamplesFor(const glm::ivec3& dims) {
    if (sampleCount(dims) <= kSmallVolumeSamples) return 2;
    const auto small = (glm::tvec3<long>(dims) + 3L) / 4L;
    return small.x * small.y * small.z > kMaxSmallBricks ? 8 : 4;
}

MinMaxGrid buildMinMaxGrid(const StoredArray& level, const glm::bvec3& periodic) {
    validateStoredArray(level);
    MinMaxGrid grid;
    grid.bricks = MinMaxGrid::bricksFor(level.dims);
    grid.ranges.resize(static_cast<std::size_t>(grid.bricks.x) * static_cast<std::size_t>(grid.bricks.y) *
                       static_cast<std::size_t>(grid.bricks.z));
    visitScalar(level.type, [&]<typename T>() { buildRanges<T>(level, periodic, grid); });
    return grid;
}

std::uint64_t contentHash(const MinMaxGrid& grid) {
    static_assert(sizeof(std::size_t) == sizeof(std::uint64_t));
    const std::string_view bytes(reinterpret_cast<const char*>(grid.ranges.data()),
                                 grid.ranges.size() * sizeof(MinMaxGrid::Range));
    std::uint64_t hash = std::hash<std::string_view>{}(bytes);
    for (int axis = 0; axis < 3; ++axis)
        hash = hash * std::uint64_t{0x9E3779B97F4A7C15U} + static_cast<std::uint64_t>(grid.bricks[axis]);
    return hash;
}

} // namespace voxsheet
