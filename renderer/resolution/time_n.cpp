#include "resolution/time_n.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {

namespace {

constexpr double kDoubtCoverage = 0.95;

void validate(int n, int level, double ms) {
    if (n < 1 || level < 0)
        throw InvalidInput("measured frame",
                           "it has " + std::to_string(n) + " datasets at level " + std::to_string(level));
    if (!std::isfinite(ms) || ms <= 0.0)
        throw InvalidInput("measured frame", "a time of " + std::to_string(ms) + " ms is none");
}

} // namespace

TimePoint TimeN::pointOf(int n, const Measured& measured) {
    if (measured.frames.empty()) {
        const auto& [ms, doubt] = measured.partly;
        return {n, {ms, std::max(0.0, ms - doubt), ms + doubt, kDoubtCoverage, 1}, true};
    }
    const std::vector<double> values(measured.frames.begin(), measured.frames.end());
    return {n, measuredMedian(values), false};
}

void TimeN::add(int n, int level, double ms) {
    validate(n, level, ms);
    auto& frames = measured_[{level, n}].frames;
    frames.push_back(ms);
    if (frames.size() > kFramesKept) frames.pop_front();
}

void TimeN::addPartly(int n, int level, double ms, double doubtMs) {
    validate(n, level, ms);
    if (!std::isfinite(doubtMs) || doubtMs < 0.0)
        throw InvalidInput("measured frame", "a doubt of " + std::to_string(doubtMs) + " ms is none");
    measured_[{level, n}].partly = {ms, doubtMs};
}

std::vector<TimePoint> TimeN::curve(int level, int largestN) const {
    std::vector<TimePoint> points;
    const auto end = measured_.upper_bound({level, largestN});
    for (auto measured = measured_.lower_bound({level, 0}); measured != end; ++measured)
        points.push_back(pointOf(measured->first.second, measured->second));
    return points;
}

std::optional<TimePoint> TimeN::point(int n, int level) const {
    const auto measured = measured_.find({level, n});
    if (measured == measured_.end()) return std::nullopt;
    return pointOf(n, measured->second);
}

std::optional<double> rawSlopeRatio(const std::vector<TimePoint>& curve) {
    if (curve.size() < 3) return std::nullopt;
    const auto& a = curve[curve.size() - 3];
    const auto& b = curve[curve.size() - 2];
    const auto& c = curve[curve.size() - 1];
    const double before = (b.ms.value - a.ms.value) / (b.n - a.n);
    const double after = (c.ms.value - b.ms.value) / (c.n - b.n);
    if (before == 0.0) return std::nullopt;
    return after / before;
}

} // namespace voxsheet
