#include "resolution/slope_rule.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {

namespace {

constexpr double kSureDifference = 5.0;
constexpr double kCertainDifference = 10.0;
constexpr double kSureWithoutOne = 3.0;
constexpr int kFramesOfALonePoint = 12;
constexpr std::size_t kNewestSteps = 4;

/// For certain, or, where there is a bend beyond doubt, more likely than not.
bool isAbove(const SlopeRatio& ratio, double limit) {
    if (!ratio.comparable) return false;
    return ratio.low > limit || (ratio.value > limit && ratio.significance > kCertainDifference);
}

struct Candidate {
    std::size_t bend = 0; ///< index of the last point before the bend
    SlopeRatio ratio;
};

std::optional<Candidate> surestBend(std::span<const TimePoint> segment) {
    std::optional<Candidate> surest;
    for (std::size_t bend = 1; bend + 1 < segment.size(); ++bend) {
        const auto ratio = slopeRatio(fitBentLine(segment, segment[bend].n));
        if (!surest || std::abs(ratio.significance) > std::abs(surest->ratio.significance))
            surest = Candidate{bend, ratio};
    }
    if (surest && std::abs(surest->ratio.significance) <= kSureDifference) surest.reset();
    return surest;
}

/// Whether a bend stays one, and above the limit if it has to be, with any one point beyond it left out.
bool holdsWithoutAnyOne(std::span<const TimePoint> segment, const Candidate& candidate,
                        std::optional<double> ratioLimit) {
    const std::size_t first = candidate.bend + 1;
    if (first + 1 == segment.size()) return segment.back().ms.count >= kFramesOfALonePoint;
    for (std::size_t left = first; left < segment.size(); ++left) {
        std::vector<TimePoint> others(segment.begin(), segment.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
        const auto ratio = slopeRatio(fitBentLine(others, segment[candidate.bend].n));
        if (std::abs(ratio.significance) <= kSureWithoutOne) return false;
        if (std::signbit(ratio.significance) != std::signbit(candidate.ratio.significance)) return false;
        if (ratioLimit && ratio.value <= *ratioLimit) return false;
    }
    return true;
}

/// Where a curve that surely broke the rule had begun to: the steepest part of it hides a bend before, which
/// alone would have to be as sure as the first. Now that there is a bend for certain, it counts when it is
/// there for certain itself and its own best estimate is above the limit.
Candidate begunAt(std::span<const TimePoint> segment, Candidate candidate, double ratioLimit) {
    while (true) {
        const auto earlier = surestBend(segment.first(candidate.bend + 1));
        if (!earlier || !earlier->ratio.comparable || earlier->ratio.significance < 0.0 ||
            earlier->ratio.value <= ratioLimit)
            return candidate;
        candidate = *earlier;
    }
}

/// A last segment that is straight in itself, but steeper than the first.
std::optional<SlopeBend> creptUp(std::span<const TimePoint> first, std::span<const TimePoint> last,
                                 double ratioLimit) {
    if (first.size() < 2 || last.size() < kNewestSteps) return std::nullopt;
    const auto ratio = slopeRatio(fitStraightLine(first), fitStraightLine(last));
    if (!isAbove(ratio, ratioLimit) || ratio.significance <= kSureDifference) return std::nullopt;
    return SlopeBend{last.front().n, last.back().n, ratio, true};
}

} // namespace

std::optional<SlopeBend> newestBend(std::span<const TimePoint> segment, double ratioLimit) {
    if (segment.size() < 3) return std::nullopt;
    const auto surest = surestBend(segment);
    if (!surest) return std::nullopt;
    const bool breaks = isAbove(surest->ratio, ratioLimit);
    const bool keeps = !surest->ratio.comparable || surest->ratio.high < ratioLimit;
    if (!breaks && !keeps) return std::nullopt;
    if (!holdsWithoutAnyOne(segment, *surest, breaks ? std::optional(ratioLimit) : std::nullopt))
        return std::nullopt;
    const auto bend = breaks ? begunAt(segment, *surest, ratioLimit) : *surest;
    return SlopeBend{segment[bend.bend].n, segment.back().n, bend.ratio, breaks};
}

std::optional<SlopeRatio> newestSlopeRatio(std::span<const TimePoint> segment) {
    if (segment.size() < 4) return std::nullopt;
    const std::size_t steps = std::min(kNewestSteps, segment.size() - 2);
    return slopeRatio(fitBentLine(segment, segment[segment.size() - 1 - steps].n));
}

std::span<const TimePoint> segmentFrom(std::span<const TimePoint> curve, int firstN) {
    const auto first = std::find_if(curve.begin(), curve.end(),
                                    [firstN](const TimePoint& point) { return point.n >= firstN; });
    return curve.subspan(static_cast<std::size_t>(first - curve.begin()));
}

namespace {

std::span<const TimePoint> upTo(std::span<const TimePoint> curve, int lastN) {
    return curve.first(curve.size() - segmentFrom(curve, lastN + 1).size());
}

} // namespace

std::optional<SlopeBend> SlopeWatch::judge(std::span<const TimePoint> curve, double ratioLimit) {
    if (curve.empty() || curve.back().n <= segmentFirstN_) *this = {};
    const auto segment = segmentFrom(curve, segmentFirstN_);
    auto bend = newestBend(segment, ratioLimit);
    if (!bend && firstBendN_ > 0) bend = creptUp(upTo(curve, firstBendN_), segment, ratioLimit);
    if (bend && bend->breaksRule && firstBendN_ > 0) {
        const auto overall = slopeRatio(fitStraightLine(upTo(curve, bend->lastN)),
                                        fitStraightLine(segmentFrom(curve, bend->lastN)));
        bend->breaksRule = isAbove(overall, ratioLimit);
        if (!bend->breaksRule && overall.high >= ratioLimit) return std::nullopt;
    }
    if (!bend || bend->breaksRule) return bend;
    segmentFirstN_ = bend->lastN;
    if (firstBendN_ == 0) firstBendN_ = bend->lastN;
    return bend;
}

std::vector<SlopeBend> findBends(std::span<const TimePoint> curve, double ratioLimit) {
    std::vector<SlopeBend> bends;
    auto rest = curve;
    SlopeWatch watch;
    for (std::size_t count = 3; count <= rest.size(); ++count) {
        const auto found = watch.judge(rest.first(count), ratioLimit);
        if (!found) continue;
        bends.push_back(*found);
        if (!found->breaksRule) continue;
        rest = segmentFrom(rest, found->lastN);
        watch = {};
        count = 2;
    }
    return bends;
}

} // namespace voxsheet
