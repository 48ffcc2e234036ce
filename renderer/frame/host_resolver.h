// As TileResolver, for pictures that were drawn in host memory.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet {

/// Blends the background under a picture and flips its rows.
/// \param drawn  rgba, premultiplied, row 0 at the bottom
/// \param background  sRGB, not premultiplied
/// \return top row first, premultiplied; 8-bit values are clamped to [0, 1] and rounded to the nearest, ties
/// to the even one, as packUnorm4x8 does
[[nodiscard]] std::vector<unsigned char> resolvedRgba8(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                                                       const glm::vec4& background);
[[nodiscard]] std::vector<float> resolvedRgba32f(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                                                 const glm::vec4& background);

} // namespace voxsheet
