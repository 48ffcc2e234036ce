#include "cli/demo/analytic_fields.h"

#include <cmath>
#include <numbers>

namespace voxsheet::cli {

namespace {

using std::numbers::pi;

/// f(x, y, z) on n^3 samples over [-extent, extent]^3.
template <typename Function>
std::vector<float> sampled(int n, double extent, Function&& f) {
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    const auto at = [&](int i) { return extent * (2.0 * i / (n - 1) - 1.0); };
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                values.push_back(static_cast<float>(f(at(i), at(j), at(k))));
    return values;
}

} // namespace

std::vector<float> marschnerLobb(int n) {
    constexpr double frequency = 6.0;
    constexpr double alpha = 0.25;
    return sampled(n, 1.0, [](double x, double y, double z) {
        const double ripple = std::cos(2.0 * pi * frequency * std::cos(pi * std::hypot(x, y) / 2.0));
        return (1.0 - std::sin(pi * z / 2.0) + alpha * (1.0 + ripple)) / (2.0 * (1.0 + alpha));
    });
}

std::vector<float> hydrogenBeat(int n, double extent, double phase) {
    return sampled(n, extent, [phase](double x, double y, double z) {
        const double r = std::sqrt(x * x + y * y + z * z);
        const double s = std::exp(-r) / std::sqrt(pi);
        const double p = z * std::exp(-r / 2.0) / (4.0 * std::sqrt(2.0 * pi));
        return 0.5 * (s * s + p * p) + s * p * std::cos(2.0 * pi * phase);
    });
}

} // namespace voxsheet::cli
