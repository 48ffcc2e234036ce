// The GPU's timestamps against the host's clock.
#pragma once

#include "frame/frame_spec.h"

namespace voxsheet {

/// Sums over tiles of frames with FrameSpec::checkTimers.
class TimerCheck {
public:
    /// They may differ by a tenth of the host's time, and by 1 ms per tile: so long may it take to copy a
    /// small tile back, which only the host's clock counts, and to wake a sleeping thread.
    static constexpr double kShare = 0.1;
    static constexpr double kFloorMs = 1.0;

    /// Tiles with an error do not count.
    void add(const FrameResult& frame);

    [[nodiscard]] double gpuMs() const { return gpuMs_; }
    [[nodiscard]] double hostMs() const { return hostMs_; }
    [[nodiscard]] int tiles() const { return tiles_; }
    [[nodiscard]] bool agrees() const;

private:
    double gpuMs_ = 0.0;
    double hostMs_ = 0.0;
    int tiles_ = 0;
};

} // namespace voxsheet
