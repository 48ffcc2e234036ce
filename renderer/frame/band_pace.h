// How much of a large picture is drawn at a stretch, so that a frame of higher priority need not wait long.
#pragma once

#include <glm/glm.hpp>

namespace voxsheet {

/// Learns from the bands drawn so far; pure arithmetic.
class BandPace {
public:
    static constexpr double bandMs = 30.0;

    /// Rows of a band, a multiple of 8; all rows of the picture when they take little longer than one.
    [[nodiscard]] int rows(glm::ivec2 sizePixels, double samplesPerPixel) const;
    /// `rows` took this long. Rows that show nothing are quick: the pace rises by 2 at most, and falls at
    /// once.
    void observe(int rows, int widthPixels, double samplesPerPixel, double ms);

private:
    double samplesPerMs_ = 0x1p24 / bandMs; ///< two cores with no GPU
};

} // namespace voxsheet
