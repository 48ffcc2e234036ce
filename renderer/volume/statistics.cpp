#include "volume/statistics.h"

#include "volume/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <type_traits>

namespace voxsheet {

namespace {

constexpr long kChunkSamples = 1L << 18;

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

Moments momentsOf(std::span<const double> values) {
    Moments m;
    m.count = values.size();
    if (values.empty()) return m;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    m.low = *low;
    m.high = *high;
    m.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (const double v : values)
        m.squares += (v - m.mean) * (v - m.mean);
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

std::size_t binOf(double value, const Histogram& histogram) {
    // Halves, because the whole width overflows for values near the ends of double.
    const double halfWidth = 0.5 * histogram.high - 0.5 * histogram.low;
    if (!(halfWidth > 0.0)) return 0;
    const double position = (0.5 * value - 0.5 * histogram.low) / halfWidth;
    const auto bin = static_cast<long>(position * kHistogramBins);
    return static_cast<std::size_t>(std::clamp(bin, 0L, static_cast<long>(kHistogramBins) - 1));
}

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
    for (std::size_t v = 0; v < valueCount; ++v)
        if (counts[v] > 0) step.histogram.counts[binOf(valueAt(v), step.histogram)] += counts[v];
    return step;
}

template <typename T>
FieldStep fromSamples(const StoredArray& array) {
    const auto* in = reinterpret_cast<const T*>(array.samples.data());
    const auto samples = static_cast<long>(array.samples.size() / sizeof(T));
    const auto valueAt = [&](long i) {
        return array.valueScale * static_cast<double>(in[i]) + array.valueOffset;
    };

    // Chunks are merged in their own order, so that the result does not depend on the number of threads.
    std::vector<Moments> chunks(static_cast<std::size_t>((samples + kChunkSamples - 1) / kChunkSamples));
    parallelFor(samples, kChunkSamples, [&](long begin, long end) {
        std::vector<double> values;
        values.reserve(static_cast<std::size_t>(end - begin));
        for (long i = begin; i < end; ++i)
            if (const double value = valueAt(i); std::isfinite(value)) values.push_back(value);
        chunks[static_cast<std::size_t>(begin / kChunkSamples)] = momentsOf(values);
    });
    Moments total;
    for (const auto& chunk : chunks)
        total.merge(chunk);
    auto step = summary(total, static_cast<std::uint64_t>(samples));

    std::mutex mutex;
    parallelFor(samples, kChunkSamples, [&](long begin, long end) {
        std::vector<std::uint64_t> local(kHistogramBins);
        for (long i = begin; i < end; ++i)
            if (const double value = valueAt(i); std::isfinite(value)) ++local[binOf(value, step.histogram)];
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
