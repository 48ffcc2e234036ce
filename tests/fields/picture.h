// Float pictures and how far apart two of them are.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace voxsheet::fields {

struct Picture {
    glm::ivec2 size{0};
    std::vector<glm::dvec4> pixels; ///< premultiplied rgba, no background; row 0 at the bottom

    Picture() = default;
    explicit Picture(glm::ivec2 pictureSize)
        : size(pictureSize),
          pixels(static_cast<std::size_t>(pictureSize.x) * static_cast<std::size_t>(pictureSize.y)) {}
    [[nodiscard]] glm::dvec4& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const glm::dvec4& at(int x, int y) const { return const_cast<Picture*>(this)->at(x, y); }
};

/// From `floats`, size.x * size.y * 4, row 0 at the bottom.
[[nodiscard]] Picture pictureFromFloats(glm::ivec2 size, const std::vector<float>& floats);

/// Pixels (n i, n j) as a picture of ceil(size / n).
[[nodiscard]] Picture everyNth(const Picture& picture, int n);

struct Difference {
    double psnr = 0.0; ///< dB, peak 1, over red, green and blue; 200 when the pictures are equal, 0 when no
                       ///< pixel counts
    double psnrAlpha = 0.0;
    double p999 = 0.0;      ///< 99.9th percentile over pixels of the largest error of a colour
    double largest = 0.0;   ///< the largest error of a colour
    std::size_t pixels = 0; ///< that count: background in neither picture
};

/// A pixel is background when no colour reaches half a step of 8 bits. Throws InvalidInput when the sizes
/// differ.
[[nodiscard]] Difference difference(const Picture& a, const Picture& b);

} // namespace voxsheet::fields
