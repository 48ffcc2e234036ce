// GPU time between two points of the command stream, by two GL_TIMESTAMP queries (GL_TIME_ELAPSED reads 0
// around compute dispatches on llvmpipe).
#pragma once

#include "gpu/object_name.h"

#include <optional>

namespace voxsheet::gpu {

class TimerQuery {
public:
    explicit TimerQuery(Context& context);
    TimerQuery(TimerQuery&&) noexcept = default;
    TimerQuery& operator=(TimerQuery&&) noexcept;
    ~TimerQuery();

    void begin();
    void end();
    /// Milliseconds between begin() and end() when the GPU has passed both; does not wait.
    [[nodiscard]] std::optional<double> tryMilliseconds() const;
    /// The same, waiting for the GPU.
    [[nodiscard]] double milliseconds() const;

private:
    ObjectName begin_;
    ObjectName end_;
};

} // namespace voxsheet::gpu
