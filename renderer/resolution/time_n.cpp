#include "resolution/time_n.h"

#include "base/errors.h"

#include <cmath>

namespace voxsheet {

namespace {

TimePoint pointOf(int n, const std::deque<double>& frames) {
    const std::vector<double> values(frames.begin(), frames.end());
    return {n, measuredMedian(values)};
}

} // namespace

void TimeN::add(int n, int level, double ms) {
    if (n < 1 || level < 0)
        throw InvalidInput("measured frame",
                           "it has " + std::to_string(n) + " datasets at level " + std::to_string(level));
    if (!std::isfinite(ms) || ms <= 0.0)
        throw InvalidInput("measured frame", "a time of " + std::to_string(ms) + " ms is none");
    auto& frames = frames_[{level, n}];
    frames.push_back(ms);
    if (frames.size() > kFramesKept) frames.pop_front();
}

std::vector<TimePoint> TimeN::curve(int level, int largestN) const {
    std::vector<TimePoint> points;
    const auto end = frames_.upper_bound({level, largestN});
    for (auto frames = frames_.lower_bound({level, 0}); frames != end; ++frames)
        points.push_back(pointOf(frames->first.second, frames->second));
    return points;
}

std::optional<TimePoint> TimeN::point(int n, int level) const {
    const auto frames = frames_.find({level, n});
    if (frames == frames_.end()) return std::nullopt;
    return pointOf(n, frames->second);
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
