#include "resolution/interactive_quality.h"

#include <algorithm>

namespace voxsheet {

namespace {

constexpr int kBelievedFrames = 240;
constexpr double kWorthwhile = 1.15; ///< a finer step that costs so little more is preferred
constexpr double kKept = 1.3;        ///< and kept

} // namespace

void InteractiveQuality::measured(double fullPixels, int step, double frameMs) {
    if (fullPixels <= 0.0 || frameMs <= 0.0) return;
    for (auto& cost : costs_)
        if (++cost.age > kBelievedFrames) cost.msPerPixel = 0.0;
    auto& cost = costs_.at(static_cast<std::size_t>(step));
    const double measured = frameMs / fullPixels;
    cost.msPerPixel = cost.msPerPixel == 0.0 ? measured : 0.7 * cost.msPerPixel + 0.3 * measured;
    cost.age = 0;
    last_ = step;
}

double InteractiveQuality::predictedMs(double fullPixels, int step) const {
    if (last_ < 0) return 0.0;
    const double known = costs_.at(static_cast<std::size_t>(step)).msPerPixel;
    if (known > 0.0) return known * fullPixels;
    const double ratio = kQualitySteps[step].relativeWork() / kQualitySteps[last_].relativeWork();
    return costs_.at(static_cast<std::size_t>(last_)).msPerPixel * fullPixels * (0.5 + 0.5 * ratio);
}

bool InteractiveQuality::fitsAtFullQuality(double fullPixels) const {
    const double known = costs_.front().msPerPixel;
    return known > 0.0 && known * fullPixels <= budgetMs_;
}

int InteractiveQuality::choose(double fullPixels) {
    if (last_ < 0) return step_;
    while (step_ + 1 < kQualityStepCount && predictedMs(fullPixels, step_) > budgetMs_)
        ++step_;
    while (step_ > 0 && predictedMs(fullPixels, step_ - 1) < 0.75 * budgetMs_)
        --step_;
    if (predictedMs(fullPixels, step_) > budgetMs_) step_ = finestOfTheCheap(fullPixels);
    return step_;
}

int InteractiveQuality::finestOfTheCheap(double fullPixels) const {
    double least = predictedMs(fullPixels, step_);
    for (int step = 0; step < step_; ++step)
        if (costs_.at(static_cast<std::size_t>(step)).msPerPixel > 0.0)
            least = std::min(least, predictedMs(fullPixels, step));
    for (int step = 0; step < step_; ++step) {
        const double known = costs_.at(static_cast<std::size_t>(step)).msPerPixel * fullPixels;
        if (known > 0.0 && known <= (step == last_ ? kKept : kWorthwhile) * least) return step;
    }
    return step_;
}

} // namespace voxsheet
