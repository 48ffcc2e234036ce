#include "frame/host_resolver.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace voxsheet {

namespace {

/// The last bit of the sum is worth 1: adding rounds as wanted, and the lowest byte is the number. NaN gives
/// 0.
unsigned char roundedByte(float value) {
    constexpr float kOneAndAHalfOf2To23 = 12582912.0F;
    const float above = value > 0.0F ? value : 0.0F;
    const float part = above < 1.0F ? above : 1.0F;
    return static_cast<unsigned char>(std::bit_cast<std::uint32_t>(part * 255.0F + kOneAndAHalfOf2To23));
}

float sameFloat(float value) { return value; }

template <typename Value, Value (*stored)(float)>
std::vector<Value> resolved(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                            const glm::vec4& background) {
    const glm::vec4 under(glm::vec3(background) * background.w, background.w);
    const auto rowValues = static_cast<std::size_t>(sizePixels.x) * 4;
    const auto rows = static_cast<std::size_t>(sizePixels.y);
    std::vector<Value> picture(rowValues * rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const float* from = drawn.data() + (rows - 1 - row) * rowValues;
        Value* to = picture.data() + row * rowValues;
        for (std::size_t i = 0; i < rowValues; i += 4) {
            const float seen = 1.0F - from[i + 3];
            for (std::size_t channel = 0; channel < 4; ++channel)
                to[i + channel] = stored(from[i + channel] + seen * under[static_cast<int>(channel)]);
        }
    }
    return picture;
}

} // namespace

std::vector<unsigned char> resolvedRgba8(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                                         const glm::vec4& background) {
    return resolved<unsigned char, roundedByte>(drawn, sizePixels, background);
}

std::vector<float> resolvedRgba32f(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                                   const glm::vec4& background) {
    return resolved<float, sameFloat>(drawn, sizePixels, background);
}

} // namespace voxsheet
