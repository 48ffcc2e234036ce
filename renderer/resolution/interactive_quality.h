// How fine to draw while something moves: the finest quality whose predicted time fits the frame budget. Pure
// arithmetic on measured times; the full dynamic-resolution controller (seed 002, section 5) joins it in this
// room.
#pragma once

namespace voxsheet {

/// Steps of quality, from full to coarsest. A step multiplies the picture's edges and the distance of
/// samples.
struct QualityStep {
    double scale;                ///< (0, 1]: edge of the rendered picture / edge of the tile
    double sampleDistanceFactor; ///< >= 1: multiplies sampling.distance
    /// Work per tile relative to full quality: scale^2 / sampleDistanceFactor.
    [[nodiscard]] constexpr double relativeWork() const { return scale * scale / sampleDistanceFactor; }
};

inline constexpr QualityStep kQualitySteps[] = {{1.0, 1.0}, {1.0, 2.0},   {0.75, 2.0},
                                                {0.5, 2.0}, {0.375, 2.5}, {0.25, 3.0}};
inline constexpr int kQualityStepCount = static_cast<int>(sizeof(kQualitySteps) / sizeof(kQualitySteps[0]));

/// Learns what a pixel at full quality costs and picks the step for the next frame.
///
/// Model: frameMs = overheadMs + costMs * pixels * relativeWork. `costMs` is an exponential mean (weight 0.3)
/// over measured frames. A finer step is taken only when its prediction stays below 75 % of the budget
/// (hysteresis), a coarser one as soon as the current step's prediction exceeds the budget.
class InteractiveQuality {
public:
    /// \param budgetMs wanted time per frame, > 0
    explicit InteractiveQuality(double budgetMs) : budgetMs_(budgetMs) {}

    /// A frame of `fullPixels` tile pixels (before scaling) was drawn, read back and encoded at `step` in
    /// `frameMs`.
    void measured(double fullPixels, int step, double frameMs);
    /// Step for the next frame of `fullPixels`. Before any measurement: the middle of the table.
    [[nodiscard]] int choose(double fullPixels);
    /// Predicted ms at a step; 0 before any measurement.
    [[nodiscard]] double predictedMs(double fullPixels, int step) const;

private:
    static constexpr double overheadMs_ = 2.0;
    double budgetMs_;
    double costMs_ = 0.0;
    int step_ = 3;
};

} // namespace voxsheet
