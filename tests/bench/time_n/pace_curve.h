// The pace of a machine over time, from looks at it.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace voxsheet::bench {

/// A value.
class PaceCurve {
public:
    using Clock = std::chrono::steady_clock;
    /// A look is as long as a few milliseconds of noise: several tell the pace.
    static constexpr std::size_t kNearest = 5;

    /// What is timed at each look took `ms` by then; in the order of time.
    void add(Clock::time_point at, double ms) { looks_.push_back({at, ms}); }
    void clear() { looks_.clear(); }
    [[nodiscard]] bool isDue(Clock::time_point now, Clock::duration every) const {
        return looks_.empty() || now - looks_.back().at >= every;
    }
    /// The median of the kNearest looks around that time (fewer when there are no more). Throws InternalError
    /// when there is none.
    [[nodiscard]] double msAt(Clock::time_point time) const;

private:
    struct Look {
        Clock::time_point at;
        double ms = 0.0;
    };
    std::vector<Look> looks_;
};

} // namespace voxsheet::bench
