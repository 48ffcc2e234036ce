// Invented time-N curves with noise of a fixed seed.
#pragma once

#include "resolution/time_n.h"

#include <algorithm>
#include <random>
#include <vector>

namespace voxsheet {

/// A straight line with bends: slope slopes[i] (ms per dataset) beyond N = bends[i - 1].
struct InventedCurve {
    double msAtZero = 0.0;
    std::vector<double> slopes{10.0};
    std::vector<int> bends;

    [[nodiscard]] double at(int n) const {
        double ms = msAtZero;
        for (std::size_t i = 0; i < slopes.size(); ++i) {
            const int from = i == 0 ? 0 : bends[i - 1];
            const int to = i < bends.size() ? bends[i] : n;
            if (n > from) ms += slopes[i] * (std::min(n, to) - from);
        }
        return ms;
    }
};

/// Multiplies by 1 + noise, Gaussian.
class Noise {
public:
    Noise(double relative, unsigned seed) : random_(seed), normal_(0.0, relative) {}
    double operator()(double ms) { return ms * (1.0 + normal_(random_)); }

private:
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
};

[[nodiscard]] inline std::vector<TimePoint> pointsOf(const InventedCurve& curve, int lastN,
                                                     Noise noise = {0.0, 1}) {
    std::vector<TimePoint> points;
    for (int n = 1; n <= lastN; ++n) {
        const double ms = noise(curve.at(n));
        points.push_back({n, measuredMedian({&ms, 1})});
    }
    return points;
}

} // namespace voxsheet
