#include "stages/banded_dispatch.h"

#include <algorithm>
#include <numeric>

namespace voxsheet {
namespace {

constexpr int kGroupPixels = 8;
constexpr double kSamplesPerDispatch = 0x1p29;

/// Near the golden section of `rows`, so that any run of multiples of it is spread evenly; no common divisor
/// with `rows`.
int rowStride(int rows) {
    int stride = std::max(1, static_cast<int>(0.618 * rows));
    while (std::gcd(stride, rows) != 1)
        ++stride;
    return stride;
}

} // namespace

int rowsPerDispatch(glm::ivec2 sizePixels, double samplesPerPixel) {
    const double perGroupRow = std::max(1.0, samplesPerPixel) * sizePixels.x * kGroupPixels;
    const double groupRows = std::clamp(kSamplesPerDispatch / perGroupRow, 1.0, 8192.0);
    return kGroupPixels * static_cast<int>(groupRows);
}

void dispatchPicture(const gpu::Program& program, glm::ivec2 sizePixels, double samplesPerPixel,
                     const PictureRows& asked) {
    program.set("targetSize", sizePixels);
    const int band = rowsPerDispatch(sizePixels, samplesPerPixel);
    const auto [first, end] = asked.within(sizePixels);
    for (int firstRow = first; firstRow < end; firstRow += band) {
        const int rows = std::min(band, end - firstRow);
        program.set("firstRow", firstRow);
        const auto groups = (glm::ivec2(sizePixels.x, rows) + kGroupPixels - 1) / kGroupPixels;
        program.set("rowStride", rowStride(groups.y));
        program.dispatch({groups, 1});
        if (firstRow + band < end) glFlush();
    }
    gpu::storageBarrier();
}

} // namespace voxsheet
