// Robust straight lines, with and without a bend, through a time-N curve.
#pragma once

#include "resolution/time_n.h"

#include <glm/glm.hpp>

#include <span>

namespace voxsheet {

/// T(n) = msAtBend + slopeBefore (n - bend) up to the bend, msAtBend + slopeAfter (n - bend) beyond it.
///
/// Huber's M-estimator (bend point 1.5; his Proposal 2 for the scale) by iteratively reweighted least
/// squares. Noise is taken as a share of T_n, the same for all points but for those whose own interval is
/// wider. Its size comes from the residuals; it starts from 1 %, which counts as much as six points, so that
/// a few points that happen to lie well do not make us certain.
struct BentLine {
    double bend = 0.0;
    double msAtBend = 0.0;
    double slopeBefore = 0.0; ///< ms per dataset
    double slopeAfter = 0.0;
    glm::dmat3 covariance{0.0}; ///< of (msAtBend, slopeBefore, slopeAfter)
    double relativeNoise = 0.0; ///< standard deviation of a point / T_n
    double degreesOfFreedom = 0.0;
};

/// Needs two points up to `bend` and one beyond; throws InvalidInput otherwise.
[[nodiscard]] BentLine fitBentLine(std::span<const TimePoint> curve, double bend);

struct StraightLine {
    double msAtZero = 0.0;
    double slope = 0.0; ///< ms per dataset
    double slopeVariance = 0.0;
    double degreesOfFreedom = 0.0;

    [[nodiscard]] double at(double n) const { return msAtZero + slope * n; }
};

/// The same estimator without a bend. Needs two points; throws InvalidInput otherwise.
[[nodiscard]] StraightLine fitStraightLine(std::span<const TimePoint> curve);

/// slopeAfter / slopeBefore.
struct SlopeRatio {
    double value = 0.0; ///< infinite when the curve did not rise before
    /// 95 % confidence (Fieller's theorem); high is infinite when the slope before may be 0.
    double low = 0.0;
    double high = 0.0;
    /// slopeAfter - slopeBefore in its own standard errors: how sure it is that there is a bend at all.
    double significance = 0.0;
    /// False when the curve surely fell before: more datasets are not drawn faster, so that other things
    /// changed meanwhile (a busy machine became idle), and there is nothing to compare with.
    bool comparable = true;
};

/// A curve that falls before the bend, but perhaps by chance, counts as level.
[[nodiscard]] SlopeRatio slopeRatio(const BentLine& line);
/// after.slope / before.slope of two lines through different points.
[[nodiscard]] SlopeRatio slopeRatio(const StraightLine& before, const StraightLine& after);

} // namespace voxsheet
