#include "bench/time_n/pace_curve.h"

#include "base/errors.h"
#include "resolution/measured_median.h"

#include <algorithm>

namespace voxsheet::bench {

double PaceCurve::msAt(Clock::time_point time) const {
    if (looks_.empty()) throw InternalError("pace of the machine", "nobody looked at it");
    const auto after = std::lower_bound(looks_.begin(), looks_.end(), time,
                                        [](const Look& look, Clock::time_point at) { return look.at < at; });
    const auto index = static_cast<std::size_t>(after - looks_.begin());
    const std::size_t count = std::min(kNearest, looks_.size());
    const std::size_t first = std::min(index - std::min(index, (kNearest + 1) / 2), looks_.size() - count);
    std::vector<double> times;
    for (std::size_t i = first; i < first + count; ++i)
        times.push_back(looks_[i].ms);
    return measuredMedian(times).value;
}

} // namespace voxsheet::bench
