// The median of repeated measurements, with the confidence interval that order statistics give it: no
// assumption on how the noise is distributed, and a single outlying measurement moves neither.
#pragma once

#include <span>

namespace voxsheet {

struct MeasuredMedian {
    double value = 0.0;
    /// The true median is in [low, high] with probability `coverage`. From six values on at least 95 %; with
    /// fewer, the interval is that of all values, and says less. A single value: low = value = high, coverage
    /// 0.
    double low = 0.0;
    double high = 0.0;
    double coverage = 0.0;
    int count = 0;

    /// Half the interval in units of a normal distribution's standard deviation; 0 where the interval says
    /// nothing (coverage 0).
    [[nodiscard]] double standardError() const;
};

/// The values between the order statistics k and count + 1 - k, with the largest k (the narrowest interval)
/// that reaches 95 %: the number of values below the median is binomial. Throws InvalidInput if there is no
/// value, or one is not finite.
[[nodiscard]] MeasuredMedian measuredMedian(std::span<const double> values);

/// The quantile of the standard normal distribution, 0 < probability < 1 (Acklam's rational approximation,
/// relative error below 1.2e-9).
[[nodiscard]] double normalQuantile(double probability);
/// The quantile of Student's distribution, by the Cornish-Fisher expansion in 1 / degreesOfFreedom; within
/// 1 % from 5 degrees of freedom on at 97.5 %.
[[nodiscard]] double studentQuantile(double probability, double degreesOfFreedom);

} // namespace voxsheet
