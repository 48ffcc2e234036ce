#include "resolution/interactive_quality.h"

#include <algorithm>

namespace voxsheet {

namespace {

constexpr int kBelievedFrames = 240;
constexpr double kWorthwhile = 1.15; ///< a finer step that costs so little more is preferred
constexpr double kKept = 1.3;        ///< and kept

} // namespace

double InteractiveQuality::Cost::typical() const {
    auto sorted = msPerPixel;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(count, kMeasurements));
    std::sort(sorted.begin(), end);
    return count == 0 ? 0.0 : sorted[isSure() ? kMeasurements / 2 : 0];
}

void InteractiveQuality::measured(double fullPixels, int step, double frameMs) {
    if (fullPixels <= 0.0 || frameMs <= 0.0) return;
    for (auto& cost : costs_)
        if (++cost.age > kBelievedFrames) cost.count = 0;
    auto& cost = costs_.at(static_cast<std::size_t>(step));
    cost.msPerPixel[cost.count++ % kMeasurements] = frameMs / fullPixels;
    cost.age = 0;
    last_ = step;
}

double InteractiveQuality::predictedMs(double fullPixels, int step) const {
    if (last_ < 0) return 0.0;
    const double known = costOf(step).typical() * fullPixels;
    if (costOf(step).isSure()) return known;
    const double ratio = kQualitySteps[step].relativeWork() / kQualitySteps[last_].relativeWork();
    const double extrapolated = costOf(last_).typical() * fullPixels * (0.5 + 0.5 * ratio);
    return known > 0.0 ? std::min(known, extrapolated) : extrapolated;
}

bool InteractiveQuality::fitsAtFullQuality(double fullPixels) const {
    const double known = costs_.front().typical();
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
        if (costOf(step).count > 0) least = std::min(least, predictedMs(fullPixels, step));
    for (int step = 0; step < step_; ++step) {
        const double known = costOf(step).typical() * fullPixels;
        if (known > 0.0 && known <= (step == last_ ? kKept : kWorthwhile) * least) return step;
    }
    return step_;
}

} // namespace voxsheet
