// How fine to draw while something moves: the finest quality whose predicted time fits the frame budget. Pure
// arithmetic on measured times; the full dynamic-resolution controller (seed 002, section 5) joins it in this
// room.
#pragma once

#include <array>
#include <cstddef>

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

/// Learns what frames cost at the steps that were drawn and picks the step for the next one.
///
/// Per step: the median of ms per tile pixel in its last five frames, believed for the next 240 frames. A
/// step without any is extrapolated from the step measured last, taking half of its time as fixed: t (1/2 +
/// work ratio / 2); so is one with fewer than five, unless one of them was quicker: first frames make what
/// later ones find ready, and a busy machine holds up any. So a finer step is tried when there is room, and
/// what it really costs is remembered. A finer step is taken only when its prediction stays below 75 % of the
/// budget (hysteresis), a coarser one as soon as the current step's prediction exceeds the budget. Where no
/// step fits, as with very many tiny tiles, whose times hardly depend on their pixels, coarse pictures would
/// be for nothing: the finest measured step counts that costs at most 15 % more than the cheapest (30 % while
/// it is drawn).
class InteractiveQuality {
public:
    /// \param budgetMs wanted time per frame, > 0
    explicit InteractiveQuality(double budgetMs) : budgetMs_(budgetMs) {}

    /// A frame of `fullPixels` tile pixels (before scaling) was drawn, read back and encoded at `step` in
    /// `frameMs`.
    void measured(double fullPixels, int step, double frameMs);
    /// Step for the next frame of `fullPixels`. Before any measurement: the middle of the table.
    [[nodiscard]] int choose(double fullPixels);
    /// Full quality has been measured, and a frame of `fullPixels` at it is predicted to stay within the
    /// budget.
    [[nodiscard]] bool fitsAtFullQuality(double fullPixels) const;
    /// Predicted ms at a step; 0 before any measurement.
    [[nodiscard]] double predictedMs(double fullPixels, int step) const;

private:
    /// When even `step_`, the coarsest, does not fit.
    [[nodiscard]] int finestOfTheCheap(double fullPixels) const;

    static constexpr std::size_t kMeasurements = 5;

    struct Cost {
        std::array<double, kMeasurements> msPerPixel{}; ///< of the last frames, the oldest overwritten next
        std::size_t count = 0;                          ///< of frames; 0: not known
        int age = 0;                                    ///< frames since it was measured

        [[nodiscard]] bool isSure() const { return count >= kMeasurements; }
        /// Their median when sure, else the least of them; 0: not known.
        [[nodiscard]] double typical() const;
    };
    [[nodiscard]] const Cost& costOf(int step) const { return costs_.at(static_cast<std::size_t>(step)); }
    double budgetMs_;
    std::array<Cost, static_cast<std::size_t>(kQualityStepCount)> costs_{};
    int last_ = -1; ///< step measured last
    int step_ = 3;
};

} // namespace voxsheet
