#include "resolution/interactive_quality.h"

#include <algorithm>

namespace voxsheet {

void InteractiveQuality::measured(double fullPixels, int step, double frameMs) {
    const double work = fullPixels * kQualitySteps[step].relativeWork();
    if (work <= 0.0 || frameMs <= 0.0) return;
    const double cost = std::max(frameMs - overheadMs_, 0.05) / work;
    costMs_ = costMs_ == 0.0 ? cost : 0.7 * costMs_ + 0.3 * cost;
}

double InteractiveQuality::predictedMs(double fullPixels, int step) const {
    if (costMs_ == 0.0) return 0.0;
    return overheadMs_ + costMs_ * fullPixels * kQualitySteps[step].relativeWork();
}

int InteractiveQuality::choose(double fullPixels) {
    if (costMs_ == 0.0) return step_;
    while (step_ + 1 < kQualityStepCount && predictedMs(fullPixels, step_) > budgetMs_)
        ++step_;
    while (step_ > 0 && predictedMs(fullPixels, step_ - 1) < 0.75 * budgetMs_)
        --step_;
    return step_;
}

} // namespace voxsheet
