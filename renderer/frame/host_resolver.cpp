#include "frame/host_resolver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxsheet {

namespace {

unsigned char roundedByte(float value) {
    return static_cast<unsigned char>(std::lrintf(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

float sameFloat(float value) { return value; }

template <typename Value>
std::vector<Value> resolved(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                            const glm::vec4& background, Value (*stored)(float)) {
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
    return resolved<unsigned char>(drawn, sizePixels, background, roundedByte);
}

std::vector<float> resolvedRgba32f(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                                   const glm::vec4& background) {
    return resolved<float>(drawn, sizePixels, background, sameFloat);
}

} // namespace voxsheet
