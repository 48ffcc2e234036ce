#include "resolution/slope_fit.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace voxsheet {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHuberBend = 1.5;
/// E[min(z^2, kHuberBend^2)] of a standard normal z: makes the scale consistent (Huber 1981, section 6.7).
constexpr double kHuberConsistency = 0.7785;
constexpr double kExpectedNoise = 0.015;
constexpr double kExpectedNoisePoints = 8.0;
constexpr int kIterations = 12;
constexpr double kConverged = 0.002; ///< relative change of the noise

/// Rows of a linear model with up to three unknowns, and what is known of each row.
struct Model {
    int unknowns = 3;
    std::vector<glm::dvec3> rows;
    std::vector<double> values;
    std::vector<double> relativeError; ///< each point's own

    void add(const glm::dvec3& row, const TimePoint& point) {
        rows.push_back(row);
        values.push_back(point.ms.value);
        relativeError.push_back(point.ms.standardError() / point.ms.value);
    }
};

struct Estimate {
    glm::dvec3 unknowns{0.0};
    glm::dmat3 covariance{0.0};
    double noise = kExpectedNoise;
    double degreesOfFreedom = 0.0;
};

class HuberRegression {
public:
    explicit HuberRegression(const Model& model) : model_(model), weight_(model.rows.size(), 1.0) {}

    [[nodiscard]] Estimate run() {
        const double spare = static_cast<double>(model_.rows.size()) - model_.unknowns;
        estimate_.degreesOfFreedom = std::max(0.0, spare) + kExpectedNoisePoints;
        for (int iteration = 0; iteration < kIterations; ++iteration) {
            solve();
            const double noiseBefore = estimate_.noise;
            updateNoise(spare);
            updateWeights();
            if (std::abs(estimate_.noise - noiseBefore) < kConverged * noiseBefore) break;
        }
        return estimate_;
    }

private:
    /// Standard deviation of a point in ms.
    [[nodiscard]] double deviation(std::size_t i) const {
        return std::max(estimate_.noise, model_.relativeError[i]) * model_.values[i];
    }

    [[nodiscard]] double standardised(std::size_t i) const {
        return (model_.values[i] - glm::dot(model_.rows[i], estimate_.unknowns)) / deviation(i);
    }

    void solve() {
        glm::dmat3 normal(0.0);
        glm::dvec3 right(0.0);
        for (int spare = model_.unknowns; spare < 3; ++spare)
            normal[spare][spare] = 1.0;
        for (std::size_t i = 0; i < model_.rows.size(); ++i) {
            const double w = weight_[i] / (deviation(i) * deviation(i));
            normal += w * glm::outerProduct(model_.rows[i], model_.rows[i]);
            right += w * model_.values[i] * model_.rows[i];
        }
        estimate_.covariance = glm::inverse(normal);
        estimate_.unknowns = estimate_.covariance * right;
    }

    void updateNoise(double spare) {
        double sum = kExpectedNoisePoints * kExpectedNoise * kExpectedNoise;
        double count = kExpectedNoisePoints;
        if (spare > 0.0) {
            double squares = 0.0;
            for (std::size_t i = 0; i < model_.rows.size(); ++i) {
                const double bounded = std::clamp(standardised(i), -kHuberBend, kHuberBend);
                squares += bounded * bounded;
            }
            sum += squares / kHuberConsistency * estimate_.noise * estimate_.noise;
            count += spare;
        }
        estimate_.noise = std::sqrt(sum / count);
    }

    void updateWeights() {
        for (std::size_t i = 0; i < weight_.size(); ++i)
            weight_[i] = std::min(1.0, kHuberBend / std::max(1e-300, std::abs(standardised(i))));
    }

    const Model& model_;
    std::vector<double> weight_;
    Estimate estimate_;
};

} // namespace

BentLine fitBentLine(std::span<const TimePoint> curve, double bend) {
    Model model;
    int before = 0;
    for (const auto& point : curve) {
        const double offset = point.n - bend;
        before += offset <= 0.0 ? 1 : 0;
        model.add({1.0, std::min(offset, 0.0), std::max(offset, 0.0)}, point);
    }
    if (before < 2 || static_cast<std::size_t>(before) == curve.size())
        throw InvalidInput("line with a bend", "it needs two points up to the bend and one beyond");
    const auto estimate = HuberRegression(model).run();
    return {bend,
            estimate.unknowns.x,
            estimate.unknowns.y,
            estimate.unknowns.z,
            estimate.covariance,
            estimate.noise,
            estimate.degreesOfFreedom};
}

StraightLine fitStraightLine(std::span<const TimePoint> curve) {
    if (curve.size() < 2) throw InvalidInput("straight line", "it needs two points");
    Model model;
    model.unknowns = 2;
    for (const auto& point : curve)
        model.add({1.0, static_cast<double>(point.n), 0.0}, point);
    const auto estimate = HuberRegression(model).run();
    return {estimate.unknowns.x, estimate.unknowns.y, estimate.covariance[1][1], estimate.degreesOfFreedom};
}

SlopeRatio slopeRatio(const BentLine& line) {
    const double before = std::max(0.0, line.slopeBefore);
    const double after = line.slopeAfter;
    const double varianceBefore = line.covariance[1][1];
    const double varianceAfter = line.covariance[2][2];
    const double shared = line.covariance[1][2];
    SlopeRatio ratio;
    ratio.value = before > 0.0 ? after / before : kInfinity;
    ratio.significance =
        (after - before) / std::sqrt(std::max(1e-300, varianceAfter - 2.0 * shared + varianceBefore));

    // Fieller: the ratios r for which after - r before is not significantly different from 0, the roots of
    // a r^2 - 2 b r + c = 0.
    const double t = studentQuantile(0.975, line.degreesOfFreedom);
    ratio.comparable = line.slopeBefore > -t * std::sqrt(varianceBefore);
    const double a = before * before - t * t * varianceBefore;
    const double b = after * before - t * t * shared;
    const double c = after * after - t * t * varianceAfter;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    if (a > 0.0) {
        ratio.low = (b - root) / a;
        ratio.high = (b + root) / a;
    } else {
        // The slope before may be 0: no upper bound, and a lower one only when there surely is a slope after.
        ratio.high = kInfinity;
        ratio.low = c > 0.0 && after > 0.0 && a < 0.0 ? (b - root) / a : (after > 0.0 ? 0.0 : -kInfinity);
    }
    return ratio;
}

SlopeRatio slopeRatio(const StraightLine& before, const StraightLine& after) {
    BentLine both;
    both.slopeBefore = before.slope;
    both.slopeAfter = after.slope;
    both.covariance[1][1] = before.slopeVariance;
    both.covariance[2][2] = after.slopeVariance;
    both.degreesOfFreedom = std::min(before.degreesOfFreedom, after.degreesOfFreedom);
    return slopeRatio(both);
}

} // namespace voxsheet
