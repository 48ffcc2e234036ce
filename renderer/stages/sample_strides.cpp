#include "stages/sample_strides.h"

#include "stages/classification.h"
#include "stages/range_memo.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <mutex>
#include <numbers>
#include <optional>

namespace voxsheet {
namespace {

constexpr long kBricksPerTask = 16384;
constexpr double kLargestExtinction = 16.0; ///< beyond, a voxel is opaque anyhow

/// Answers "the largest over [first, last]?" in constant time: element i of row k is that of 2^k from i on.
class RangeMaximum {
public:
    explicit RangeMaximum(std::vector<float> values) {
        rows_.push_back(std::move(values));
        for (std::size_t width = 2; width <= rows_[0].size(); width *= 2) {
            const auto& half = rows_.back();
            std::vector<float> row(rows_[0].size() - width + 1);
            for (std::size_t i = 0; i < row.size(); ++i)
                row[i] = std::max(half[i], half[i + width / 2]);
            rows_.push_back(std::move(row));
        }
    }
    [[nodiscard]] float over(std::size_t first, std::size_t last) const {
        const auto k = static_cast<std::size_t>(std::bit_width(last - first + 1) - 1);
        return std::max(rows_[k][first], rows_[k][last + 1 - (std::size_t{1} << k)]);
    }

private:
    std::vector<std::vector<float>> rows_;
};

/// What a table shows over ranges of its entries, those of shaderTable().
class TableChanges {
public:
    explicit TableChanges(const TransferTable& table) : table_(table), largest_({0.0F}) {
        emission_ = shaderTable(table);
        std::vector<float> extinctions;
        for (auto& entry : emission_) {
            entry.w = std::min(entry.w * static_cast<float>(std::numbers::ln2),
                               static_cast<float>(kLargestExtinction));
            extinctions.push_back(entry.w);
            entry = glm::vec4(glm::vec3(entry) * entry.w, entry.w);
        }
        variation_.push_back(0.0);
        sums_.emplace_back(0.0);
        for (std::size_t i = 0; i < emission_.size(); ++i) {
            const auto step = glm::abs(emission_[i] - emission_[i > 0 ? i - 1 : 0]);
            variation_.push_back(variation_.back() + double(largestOf(step)));
            sums_.push_back(sums_.back() + glm::dvec4(emission_[i]));
        }
        largest_ = RangeMaximum(std::move(extinctions));
        for (std::size_t width = 2; width < 2 * emission_.size(); width *= 2)
            bends_.emplace_back();
    }

    struct Entries {
        std::size_t first, last;
    };
    [[nodiscard]] Entries entriesOf(const MinMaxGrid::Range& range) const {
        const double last = static_cast<double>(table_.entries.size() - 1);
        const auto entry = [&](double value) {
            return std::clamp(tablePosition(table_, value) * last + 1.0, 0.0, last + 2.0);
        };
        return {static_cast<std::size_t>(std::floor(entry(double(range.low)))),
                static_cast<std::size_t>(std::ceil(entry(double(range.high))))};
    }
    [[nodiscard]] double largest(const Entries& at) const { return double(largest_.over(at.first, at.last)); }
    [[nodiscard]] double variation(const Entries& at) const {
        return variation_[at.last + 1] - variation_[at.first + 1];
    }
    /// Largest difference of an entry to the mean of `width` entries about it.
    [[nodiscard]] double bend(const Entries& at, double width) const {
        if (width < 1.0) return 0.0;
        const auto k =
            static_cast<std::size_t>(std::bit_width(static_cast<std::size_t>(std::ceil(width)) - 1));
        if (k == 0) return 0.0;
        const std::size_t element = std::min(k, bends_.size()) - 1;
        auto& bends = bends_[element];
        std::call_once(bends.made, [&] { bends.largest.emplace(bendsOver(std::size_t{2} << element)); });
        return double(bends.largest->over(at.first, at.last));
    }

private:
    static float largestOf(const glm::vec4& v) { return std::max({v.x, v.y, v.z, v.w}); }

    [[nodiscard]] std::vector<float> bendsOver(std::size_t width) const {
        const auto count = static_cast<long>(emission_.size());
        const auto half = static_cast<long>(width / 2);
        // Beyond the ends the table goes on as it ends.
        const auto sumTo = [&](long end) {
            const auto inside = static_cast<std::size_t>(std::clamp(end, 0L, count));
            const glm::dvec4 before = glm::dvec4(emission_.front()) * static_cast<double>(std::min(end, 0L));
            const glm::dvec4 after =
                glm::dvec4(emission_.back()) * static_cast<double>(std::max(end - count, 0L));
            return before + sums_[inside] + after;
        };
        std::vector<float> bends;
        bends.reserve(emission_.size());
        for (long i = 0; i < count; ++i) {
            const glm::dvec4 sum = sumTo(i + half + 1) - sumTo(i - half);
            const auto mean = glm::vec4(sum / static_cast<double>(2 * half + 1));
            bends.push_back(largestOf(glm::abs(mean - emission_[static_cast<std::size_t>(i)])));
        }
        return bends;
    }

    const TransferTable& table_;
    std::vector<glm::vec4> emission_; ///< extinction times (rgb, 1)
    std::vector<double> variation_;
    std::vector<glm::dvec4> sums_;
    RangeMaximum largest_;
    /// Few widths are ever asked for.
    struct Bends {
        std::once_flag made;
        std::optional<RangeMaximum> largest;
    };
    mutable std::deque<Bends> bends_; ///< element k: over 2^(k + 1) entries
};

std::uint8_t exponentOf(const MinMaxGrid::Range& range, const TableChanges& changes,
                        const StrideSettings& settings, int longest) {
    if (std::isnan(range.low) || std::isnan(range.high)) return 0;
    if (range.low > range.high) return static_cast<std::uint8_t>(longest);
    const auto entries = changes.entriesOf(range);
    const double extinction = changes.largest(entries);
    if (extinction == 0.0) return static_cast<std::uint8_t>(longest);
    const double variation = changes.variation(entries);
    const double width = static_cast<double>(entries.last - entries.first);
    const double light = settings.lit ? extinction : 0.0;
    // Ranges are over one sample more on both sides: over 5 voxels of a brick of 4.
    const double brickWidth = std::min(1.0, (settings.brickSamples + 1) / 5.0);
    for (int exponent = longest; exponent > 0; --exponent) {
        const double voxels = settings.sampleDistanceVoxels * static_cast<double>(1 << exponent);
        const double ofBrick = voxels / brickWidth;
        const double bend = changes.bend(entries, width * std::min(1.0, ofBrick / 3.0));
        const double error =
            voxels * settings.unitsPerVoxel * (bend + variation * ofBrick / 48.0 + light * voxels / 24.0);
        if (error <= kLargestStrideError) return static_cast<std::uint8_t>(exponent);
    }
    return 0;
}

} // namespace

std::vector<std::uint8_t> strideExponents(const MinMaxGrid& grid, const TransferTable& table,
                                          const StrideSettings& settings) {
    int longest = 0;
    while (settings.sampleDistanceVoxels * static_cast<double>(2 << longest) <= kLongestStrideVoxels)
        ++longest;
    std::vector<std::uint8_t> exponents(grid.ranges.size());
    if (longest == 0) return exponents;
    const TableChanges changes(table);
    const auto exponent = [&](const MinMaxGrid::Range& range) {
        return exponentOf(range, changes, settings, longest);
    };
    parallelFor(static_cast<long>(exponents.size()), kBricksPerTask, [&](long begin, long end) {
        RangeMemo<std::uint8_t> memo;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
            exponents[i] = memo(grid.ranges[i], exponent);
    });
    return exponents;
}

} // namespace voxsheet
