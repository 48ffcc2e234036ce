#include "frame/timer_check.h"

#include <cmath>

namespace voxsheet {

void TimerCheck::add(const FrameResult& frame) {
    for (const auto& tile : frame.tiles) {
        if (!tile.error.empty()) continue;
        gpuMs_ += tile.timestampMs;
        hostMs_ += tile.hostMs;
        ++tiles_;
    }
}

bool TimerCheck::agrees() const { return std::abs(gpuMs_ - hostMs_) <= kShare * hostMs_ + kFloorMs * tiles_; }

} // namespace voxsheet
