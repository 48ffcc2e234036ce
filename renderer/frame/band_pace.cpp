#include "frame/band_pace.h"

#include <algorithm>

namespace voxsheet {

int BandPace::rows(glm::ivec2 sizePixels, double samplesPerPixel) const {
    const double samplesPerRow = std::max(1.0, samplesPerPixel) * sizePixels.x;
    const double rows = samplesPerMs_ * bandMs / samplesPerRow;
    if (1.5 * rows >= sizePixels.y) return sizePixels.y;
    return std::max(8, static_cast<int>(rows) / 8 * 8);
}

void BandPace::observe(int rows, int widthPixels, double samplesPerPixel, double ms) {
    const double samples = std::max(1.0, samplesPerPixel) * widthPixels * rows;
    samplesPerMs_ = std::min(2.0 * samplesPerMs_, samples / std::max(ms, 1e-3));
}

} // namespace voxsheet
