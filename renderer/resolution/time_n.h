// T_N, the time of a frame that shows N datasets (Khanduja & Karki 2007, section 3 and figures 6 to 8), for
// each N and each level of detail, out of the frames that were drawn.
#pragma once

#include "resolution/measured_median.h"

#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace voxsheet {

/// One point of a time-N curve.
struct TimePoint {
    int n = 0;
    MeasuredMedian ms;
    bool partly = false; ///< no frame of all n was drawn yet: put together from frames of some of them
};

/// A value: copies are independent.
class TimeN {
public:
    /// Frames that a point remembers; the oldest go first.
    static constexpr std::size_t kFramesKept = 15;

    /// A frame of all n datasets at one level took `ms`. Throws InvalidInput unless n >= 1, level >= 0 and ms
    /// is finite and > 0.
    void add(int n, int level, double ms);
    /// Some of n datasets were drawn again, and what the others took is known from when they were drawn last:
    /// `ms` together. Counts until the first frame of all n; a newer one replaces it.
    /// \param doubtMs  half of the 95 % interval of `ms`, >= 0
    void addPartly(int n, int level, double ms, double doubtMs);

    /// The curve of a level for all N up to `largestN`, ascending in N.
    [[nodiscard]] std::vector<TimePoint> curve(int level, int largestN) const;
    [[nodiscard]] std::optional<TimePoint> point(int n, int level) const;

private:
    struct Partly {
        double ms = 0.0;
        double doubtMs = 0.0;
    };
    struct Measured {
        std::deque<double> frames;
        Partly partly; ///< counts while there are no frames
    };
    [[nodiscard]] static TimePoint pointOf(int n, const Measured& measured);

    std::map<std::pair<int, int>, Measured> measured_; ///< by level and N
};

/// The paper's R = (T_{N+1} - T_N) / (T_N - T_{N-1}) of a curve's last three points. Where N jumps, each
/// difference is divided by its step of N. Nothing with fewer than three points, or when the two earlier
/// times are equal.
[[nodiscard]] std::optional<double> rawSlopeRatio(const std::vector<TimePoint>& curve);

} // namespace voxsheet
