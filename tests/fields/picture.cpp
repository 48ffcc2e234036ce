#include "fields/picture.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::fields {
namespace {

bool isBackground(const glm::dvec4& pixel) { return std::max({pixel.x, pixel.y, pixel.z}) < 0.5 / 255.0; }

double decibels(double meanSquare) { return meanSquare > 1e-20 ? -10.0 * std::log10(meanSquare) : 200.0; }

} // namespace

Picture pictureFromFloats(glm::ivec2 size, const std::vector<float>& floats) {
    Picture picture(size);
    if (floats.size() != picture.pixels.size() * 4)
        throw InvalidInput("float picture", "its number of floats does not fit its size");
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = {floats[4 * i], floats[4 * i + 1], floats[4 * i + 2], floats[4 * i + 3]};
    return picture;
}

Picture everyNth(const Picture& picture, int n) {
    Picture result((picture.size + n - 1) / n);
    for (int y = 0; y < result.size.y; ++y)
        for (int x = 0; x < result.size.x; ++x)
            result.at(x, y) = picture.at(x * n, y * n);
    return result;
}

Difference difference(const Picture& a, const Picture& b) {
    if (a.size != b.size) throw InvalidInput("pictures to compare", "their sizes differ");
    Difference result;
    std::vector<double> errors;
    double squares = 0.0;
    double alphaSquares = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (isBackground(a.pixels[i]) || isBackground(b.pixels[i])) continue;
        const auto error = glm::abs(a.pixels[i] - b.pixels[i]);
        squares += (error.x * error.x + error.y * error.y + error.z * error.z) / 3.0;
        alphaSquares += error.w * error.w;
        errors.push_back(std::max({error.x, error.y, error.z}));
    }
    result.pixels = errors.size();
    if (errors.empty()) return result;
    const double count = static_cast<double>(errors.size());
    result.psnr = decibels(squares / count);
    result.psnrAlpha = decibels(alphaSquares / count);
    std::sort(errors.begin(), errors.end());
    const auto rank = static_cast<std::size_t>(std::ceil(0.999 * count)) - 1;
    result.p999 = errors[rank];
    result.largest = errors.back();
    return result;
}

} // namespace voxsheet::fields
