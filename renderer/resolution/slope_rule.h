// Where a time-N curve bends, and whether that breaks the rule R > 1.5 of Khanduja & Karki 2007, section 5:
// R is taken from fitted slopes, with confidence.
//
// The raw R of three neighbouring points is fragile: on an exactly linear curve with 0.2 % noise it exceeds
// 1.5 before N = 64 in four of five runs. Here lines with a bend are fitted through the whole segment of the
// curve, for every N where the bend may be. The surest bend counts when
//  - the slopes differ by five standard errors (every new point tests all bends, so that one test in many
//    millions may be wrong), and
//  - that is not because of a single point: with any one point beyond the bend left out, the difference stays
//    above three standard errors. One point alone will do when it is the median of at least 12 frames.
// It breaks the rule when the lower 95 % confidence bound of the ratio of slopes is above the limit (and the
// ratio itself, with any one point left out). Where the slopes differ by ten standard errors, the ratio
// itself decides: that the curve bends is beyond doubt then, and waiting for its ratio to be certainly above
// a limit close by would take longer than most curves last. A bend is known to keep the rule when the upper
// bound is below the limit, and it is taken to when the curve fell before. In between, more points are
// awaited. A curve that broke the rule did so from the first bend before that whose difference is as sure and
// whose ratio is above the limit, sure or not: where a texture budget fills, the curve often rises in two
// steps.
#pragma once

#include "resolution/slope_fit.h"

#include <optional>
#include <span>
#include <vector>

namespace voxsheet {

/// The paper's limit, which its first transition (texture memory full) stays below.
inline constexpr double kPaperRatioLimit = 1.5;
/// "The condition could be modified to capture the first transition": a limit that does.
inline constexpr double kFirstTransitionRatioLimit = 1.2;

struct SlopeBend {
    int lastN = 0;     ///< the last N before the bend
    int detectedN = 0; ///< the N at which the verdict was certain
    SlopeRatio ratio;  ///< slope after `lastN` / slope before
    bool breaksRule = false;
};

/// The bend of a segment that its newest points reveal, once the verdict on it is certain. A segment is a
/// piece of a curve that has no earlier certain bend. Nothing with fewer than three points, for a straight
/// segment, and for one that is too noisy to tell.
[[nodiscard]] std::optional<SlopeBend> newestBend(std::span<const TimePoint> segment, double ratioLimit);

/// Fitted R at a segment's last point: slope of its newest points (four steps; fewer when it is short)
/// against the slope before. Nothing with fewer than four points.
[[nodiscard]] std::optional<SlopeRatio> newestSlopeRatio(std::span<const TimePoint> segment);

/// The points of a curve from N = firstN on.
[[nodiscard]] std::span<const TimePoint> segmentFrom(std::span<const TimePoint> curve, int firstN);

/// Follows a curve while N grows: remembers where its segments begin. A value.
class SlopeWatch {
public:
    /// Judges the curve up to its last point. After a bend that keeps the rule a new segment begins at it.
    /// From then on a bend breaks the rule only when the slope after it is, as surely, above the limit
    /// against the whole curve before it as well: a curve that was flatter for a while may go on as it began.
    /// A segment without a bend of its own is compared with the curve's first one, so that a slope that
    /// creeps up breaks the rule at last. When the curve ends before the last known bend (N shrank), the
    /// segments are forgotten.
    [[nodiscard]] std::optional<SlopeBend> judge(std::span<const TimePoint> curve, double ratioLimit);

    /// Where the newest segment begins; 0 = with the curve.
    [[nodiscard]] int segmentFirstN() const { return segmentFirstN_; }

private:
    int firstBendN_ = 0; ///< where the first segment ends; 0 = there is only one
    int segmentFirstN_ = 0;
};

/// All certain bends of a finished curve, in the order in which they would have been found while N grew; the
/// curve is judged anew from each that breaks the rule.
[[nodiscard]] std::vector<SlopeBend> findBends(std::span<const TimePoint> curve, double ratioLimit);

} // namespace voxsheet
