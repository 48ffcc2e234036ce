#include "resolution/measured_median.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxsheet {

namespace {

constexpr double kCoverage = 0.95;

/// Probability that the median lies outside of the order statistics k and count + 1 - k.
double missed(int count, int k) {
    double tail = 0.0;
    for (int below = 0; below < k; ++below)
        tail += std::exp(std::lgamma(count + 1.0) - std::lgamma(below + 1.0) -
                         std::lgamma(count - below + 1.0) - count * std::log(2.0));
    return 2.0 * tail;
}

} // namespace

double MeasuredMedian::standardError() const {
    return coverage <= 0.0 ? 0.0 : 0.5 * (high - low) / normalQuantile(0.5 + 0.5 * coverage);
}

MeasuredMedian measuredMedian(std::span<const double> values) {
    if (values.empty()) throw InvalidInput("median", "there is no value");
    std::vector<double> sorted(values.begin(), values.end());
    if (!std::all_of(sorted.begin(), sorted.end(), [](double value) { return std::isfinite(value); }))
        throw InvalidInput("median", "a value is not finite");
    std::sort(sorted.begin(), sorted.end());
    const auto count = static_cast<int>(sorted.size());
    const auto middle = sorted.size() / 2;
    MeasuredMedian result;
    result.value = sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
    int k = 1;
    while (2 * (k + 1) <= count && missed(count, k + 1) <= 1.0 - kCoverage)
        ++k;
    result.low = sorted[static_cast<std::size_t>(k - 1)];
    result.high = sorted[static_cast<std::size_t>(count - k)];
    result.coverage = count < 2 ? 0.0 : 1.0 - missed(count, k);
    result.count = count;
    return result;
}

double normalQuantile(double probability) {
    if (!(probability > 0.0 && probability < 1.0))
        throw InvalidInput("quantile", "the probability must be between 0 and 1");
    if (probability < 0.5) return -normalQuantile(1.0 - probability);
    constexpr double kTail = 1.0 - 0.02425;
    if (probability > kTail) {
        const double q = std::sqrt(-2.0 * std::log(1.0 - probability));
        return -(((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838e+00) * q -
                   2.549732539343734e+00) *
                      q +
                  4.374664141464968e+00) *
                     q +
                 2.938163982698783e+00) /
               ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996e+00) * q +
                 3.754408661907416e+00) *
                    q +
                1.0);
    }
    const double q = probability - 0.5;
    const double r = q * q;
    return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
              1.383577518672690e+02) *
                 r -
             3.066479806614716e+01) *
                r +
            2.506628277459239e+00) *
           q /
           (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
              6.680131188771972e+01) *
                 r -
             1.328068155288572e+01) *
                r +
            1.0);
}

double studentQuantile(double probability, double degreesOfFreedom) {
    const double z = normalQuantile(probability);
    const double z3 = z * z * z;
    const double z5 = z3 * z * z;
    const double n = degreesOfFreedom;
    return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n);
}

} // namespace voxsheet
