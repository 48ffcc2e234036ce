#include "volume/statistics.h"

#include "volume/parallel_for.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <type_traits>

namespace voxsheet {

namespace {

constexpr long kChunkSamples = 1L << 18;
constexpr long kBlockSamples = 1L << 13; ///< of a chunk, which as doubles stay in a core's cache

/// How often each value occurs, or what a chunk of samples adds up to; enough to merge chunks in any order.
struct Moments {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double mean = 0.0;
    double squares = 0.0; ///< sum of (v - mean)^2
    std::uint64_t count = 0;

    /// Chan, Golub & LeVeque 1979, "Updating formulae and a pairwise algorithm for computing sample
    /// variances".
    void merge(const Moments& other) {
        if (other.count == 0) return;
        const auto a = static_cast<double>(count);
        const auto b = static_cast<double>(other.count);
        const double delta = other.mean - mean;
        mean += delta * (b / (a + b));
        squares += other.squares + delta * delta * (a * b / (a + b));
        count += other.count;
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }
};

/// Sums run in this many lanes: a single one would wait for each addition before the next.
constexpr std::size_t kLanes = 8;

template <typename Each>
void inLanes(std::span<const double> values, const Each& each) {
    const std::size_t whole = values.size() / kLanes * kLanes;
    for (std::size_t i = 0; i < whole; i += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            each(lane, values[i + lane]);
    for (std::size_t i = whole; i < values.size(); ++i)
        each(i - whole, values[i]);
}

Moments momentsOf(std::span<const double> values) {
    Moments m;
    m.count = values.size();
    if (values.empty()) return m;
    std::array<double, kLanes> low;
    std::array<double, kLanes> high;
    std::array<double, kLanes> sum{};
    low.fill(values[0]);
    high.fill(values[0]);
    inLanes(values, [&](std::size_t lane, double v) {
        low[lane] = v < low[lane] ? v : low[lane];
        high[lane] = v > high[lane] ? v : high[lane];
        sum[lane] += v;
    });
    m.low = *std::min_element(low.begin(), low.end());
    m.high = *std::max_element(high.begin(), high.end());
    m.mean = std::accumulate(sum.begin(), sum.end(), 0.0) / static_cast<double>(values.size());
    std::array<double, kLanes> squares{};
    inLanes(values, [&](std::size_t lane, double v) { squares[lane] += (v - m.mean) * (v - m.mean); });
    m.squares = std::accumulate(squares.begin(), squares.end(), 0.0);
    return m;
}

FieldStep summary(const Moments& total, std::uint64_t samples) {
    FieldStep step;
    step.histogram.counts.assign(kHistogramBins, 0);
    step.statistics.finiteCount = total.count;
    step.statistics.nanCount = samples - total.count;
    if (total.count == 0) return step;
    step.statistics.min = step.histogram.low = total.low;
    step.statistics.max = step.histogram.high = total.high;
    step.statistics.mean = std::clamp(total.mean, total.low, total.high);
    step.statistics.standardDeviation =
        std::sqrt(std::max(0.0, total.squares / static_cast<double>(total.count)));
    return step;
}

/// The bins of a histogram by value.
class Bins {
public:
    explicit Bins(const Histogram& histogram)
        // Halves, because the whole width overflows for values near the ends of double.
        : halfLow_(0.5 * histogram.low), halfWidth_(0.5 * histogram.high - 0.5 * histogram.low) {}

    /// \param value  finite
    [[nodiscard]] int of(double value) const {
        const double place = (0.5 * value - halfLow_) / halfWidth_ * kHistogramBins;
        const double above = place > 0.0 ? place : 0.0; // 0 where all values are equal, too: 0 / 0
        return static_cast<int>(above < kHistogramBins - 1 ? above : kHistogramBins - 1);
    }

private:
    double halfLow_;
    double halfWidth_;
};

/// 8- and 16-bit samples: count each of the possible values once, then everything else is exact and cheap.
template <typename T>
FieldStep fromCounts(const StoredArray& array) {
    constexpr auto lowest = static_cast<int>(std::numeric_limits<T>::lowest());
    constexpr auto valueCount = static_cast<std::size_t>(std::numeric_limits<T>::max() - lowest) + 1;
    const auto* in = reinterpret_cast<const T*>(array.samples.data());
    const auto samples = static_cast<long>(array.samples.size() / sizeof(T));

    std::vector<std::uint64_t> counts(valueCount);
    std::mutex mutex;
    parallelFor(samples, std::max(kChunkSamples, samples / 64), [&](long begin, long end) {
        std::vector<std::uint64_t> local(valueCount);
        for (long i = begin; i < end; ++i)
            ++local[static_cast<std::size_t>(in[i] - lowest)];
        const std::lock_guard lock(mutex);
        for (std::size_t v = 0; v < valueCount; ++v)
            counts[v] += local[v];
    });

    const auto valueAt = [&](std::size_t v) {
        return array.valueScale * (static_cast<double>(v) + lowest) + array.valueOffset;
    };
    Moments total;
    for (std::size_t v = 0; v < valueCount; ++v)
        if (counts[v] > 0) {
            const double value = valueAt(v);
            total.merge({value, value, value, 0.0, counts[v]});
        }
    auto step = summary(total, static_cast<std::uint64_t>(samples));
    const Bins bins(step.histogram);
    for (std::size_t v = 0; v < valueCount; ++v)
        if (counts[v] > 0) step.histogram.counts[static_cast<std::size_t>(bins.of(valueAt(v)))] += counts[v];
    return step;
}

/// Calls each(values) with the finite values of samples [begin, end), a block at a time.
template <typename T, typename Each>
void forFiniteBlocks(const StoredArray& array, long begin, long end, const Each& each) {
    const auto* in = reinterpret_cast<const T*>(array.samples.data());
    std::vector<double> values(kBlockSamples);
    for (long block = begin; block < end; block += kBlockSamples) {
        const auto count = static_cast<std::size_t>(std::min(kBlockSamples, end - block));
        bool allFinite = true;
        for (std::size_t i = 0; i < count; ++i) {
            values[i] =
                array.valueScale * static_cast<double>(in[block + static_cast<long>(i)]) + array.valueOffset;
            allFinite &= std::abs(values[i]) <= std::numeric_limits<double>::max();
        }
        const auto last = values.begin() + static_cast<std::ptrdiff_t>(count);
        const auto finiteEnd =
            allFinite ? last
                      : std::remove_if(values.begin(), last, [](double v) { return !std::isfinite(v); });
        each(std::span<const double>(values.begin(), finiteEnd));
    }
}

template <typename T>
FieldStep fromSamples(const StoredArray& array) {
    const auto samples = static_cast<long>(array.samples.size() / sizeof(T));
    // Chunks are merged in their own order, so that the result does not depend on the number of threads.
    std::vector<Moments> chunks(static_cast<std::size_t>((samples + kChunkSamples - 1) / kChunkSamples));
    parallelFor(samples, kChunkSamples, [&](long begin, long end) {
        auto& chunk = chunks[static_cast<std::size_t>(begin / kChunkSamples)];
        forFiniteBlocks<T>(array, begin, end,
                           [&](std::span<const double> values) { chunk.merge(momentsOf(values)); });
    });
    Moments total;
    for (const auto& chunk : chunks)
        total.merge(chunk);
    auto step = summary(total, static_cast<std::uint64_t>(samples));

    std::mutex mutex;
    const Bins bins(step.histogram);
    parallelFor(samples, kChunkSamples, [&](long begin, long end) {
        std::vector<std::uint64_t> local(kHistogramBins);
        std::vector<int> places(kBlockSamples);
        forFiniteBlocks<T>(array, begin, end, [&](std::span<const double> values) {
            std::transform(values.begin(), values.end(), places.begin(),
                           [&](double v) { return bins.of(v); });
            for (std::size_t i = 0; i < values.size(); ++i)
                ++local[static_cast<std::size_t>(places[i])];
        });
        const std::lock_guard lock(mutex);
        for (std::size_t b = 0; b < local.size(); ++b)
            step.histogram.counts[b] += local[b];
    });
    return step;
}

} // namespace

FieldStep computeStatistics(const StoredArray& array) {
    validateStoredArray(array);
    return visitScalar(array.type, [&]<typename T>() {
        if constexpr (sizeof(T) <= 2)
            return fromCounts<T>(array);
        else
            return fromSamples<T>(array);
    });
}

} // namespace voxsheet
