#include "volume/pyramid.h"

#include "volume/dataset.h"
#include "volume/grid.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace voxsheet {

namespace {

/// The finer samples that one coarse sample covers, and how much of each.
struct Taps {
    int first = 0;
    int count = 0;
    std::array<double, 3> weights{};
};

std::vector<Taps> axisTaps(int finer) {
    const int coarser = (finer + 1) / 2;
    std::vector<Taps> taps(static_cast<std::size_t>(coarser));
    for (int c = 0; c < coarser; ++c) {
        // Exact integer bounds in units of 1/coarser of a finer sample.
        const long low = static_cast<long>(c) * finer;
        const long high = low + finer;
        auto& tap = taps[static_cast<std::size_t>(c)];
        tap.first = static_cast<int>(low / coarser);
        for (long i = tap.first; i * coarser < high; ++i) {
            const long overlap = std::min(high, (i + 1) * coarser) - std::max(low, i * coarser);
            tap.weights[static_cast<std::size_t>(tap.count++)] =
                static_cast<double>(overlap) / static_cast<double>(coarser);
        }
    }
    return taps;
}

/// Weighted sums of whole rows of the finer level. Integers have no absent samples, so they need no weight
/// per sample.
template <typename T>
class RowSums {
public:
    static constexpr bool hasAbsent = std::is_floating_point_v<T>;
    using Sum = std::conditional_t<(sizeof(T) <= 2), float, double>;

    explicit RowSums(int length) : sums_(static_cast<std::size_t>(length)) {
        if constexpr (hasAbsent) weights_.resize(static_cast<std::size_t>(length));
    }

    void clear() {
        std::fill(sums_.begin(), sums_.end(), Sum(0));
        std::fill(weights_.begin(), weights_.end(), Sum(0));
        rowWeight_ = 0;
    }

    void add(const T* row, double rowWeight) {
        const auto weight = static_cast<Sum>(rowWeight);
        rowWeight_ += weight;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            if constexpr (hasAbsent) {
                const bool present = std::abs(row[i]) <= std::numeric_limits<T>::max();
                sums_[i] += present ? weight * static_cast<Sum>(row[i]) : Sum(0);
                weights_[i] += present ? weight : Sum(0);
            } else {
                sums_[i] += weight * static_cast<Sum>(row[i]);
            }
        }
    }

    [[nodiscard]] Sum mean(const Taps& taps) const {
        Sum sum = 0;
        Sum total = 0;
        for (int t = 0; t < taps.count; ++t) {
            const auto i = static_cast<std::size_t>(taps.first + t);
            const auto weight = static_cast<Sum>(taps.weights[static_cast<std::size_t>(t)]);
            sum += weight * sums_[i];
            total += weight * (hasAbsent ? weights_[hasAbsent ? i : 0] : rowWeight_);
        }
        return total > Sum(0) ? sum / total : std::numeric_limits<Sum>::quiet_NaN();
    }

private:
    std::vector<Sum> sums_;
    std::vector<Sum> weights_;
    Sum rowWeight_ = 0;
};

template <typename Out, typename Sum>
Out rounded(Sum mean) {
    if constexpr (std::is_floating_point_v<Out>) {
        return static_cast<Out>(mean);
    } else {
        return static_cast<Out>(std::round(mean)); // a mean of Out values: always in range
    }
}

template <typename T, typename Out>
void coarsen(const StoredArray& finer, Out* out) {
    const auto* in = reinterpret_cast<const T*>(finer.samples.data());
    const auto tapsX = axisTaps(finer.dims.x);
    const auto tapsY = axisTaps(finer.dims.y);
    const auto tapsZ = axisTaps(finer.dims.z);
    const auto rowLength = static_cast<std::size_t>(finer.dims.x);
    parallelFor(static_cast<long>(tapsZ.size()), 1, [&](long begin, long end) {
        RowSums<T> sums(finer.dims.x);
        for (auto z = static_cast<std::size_t>(begin); z < static_cast<std::size_t>(end); ++z)
            for (std::size_t y = 0; y < tapsY.size(); ++y) {
                sums.clear();
                for (int dz = 0; dz < tapsZ[z].count; ++dz)
                    for (int dy = 0; dy < tapsY[y].count; ++dy) {
                        const auto row = static_cast<std::size_t>(tapsZ[z].first + dz) *
                                             static_cast<std::size_t>(finer.dims.y) +
                                         static_cast<std::size_t>(tapsY[y].first + dy);
                        sums.add(in + row * rowLength, tapsZ[z].weights[static_cast<std::size_t>(dz)] *
                                                           tapsY[y].weights[static_cast<std::size_t>(dy)]);
                    }
                Out* const outRow = out + (z * tapsY.size() + y) * tapsX.size();
                for (std::size_t x = 0; x < tapsX.size(); ++x)
                    outRow[x] = rounded<Out>(sums.mean(tapsX[x]));
            }
    });
}

} // namespace

glm::ivec3 coarserDims(const glm::ivec3& dims) { return levelDims(dims, 1); }

std::vector<std::byte> coarserLevel(const StoredArray& finer) {
    validateStoredArray(finer);
    const auto samples = static_cast<std::size_t>(sampleCount(coarserDims(finer.dims)));
    std::vector<std::byte> coarser(samples * scalarBytes(pyramidType(finer.type)));
    visitScalar(finer.type, [&]<typename T>() {
        using Out = std::conditional_t<(sizeof(T) <= 2), T, float>;
        coarsen<T>(finer, reinterpret_cast<Out*>(coarser.data()));
    });
    return coarser;
}

} // namespace voxsheet
