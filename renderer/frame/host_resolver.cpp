#include "frame/host_resolver.h"

#include <array>
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

constexpr std::size_t kBlockPixels = 4; ///< a fixed number, so that compilers make vectors of it
constexpr std::size_t kBlockValues = kBlockPixels * 4;
using Block = std::array<float, kBlockValues>;

/// The background, premultiplied.
Block blockOf(const glm::vec4& background) {
    const glm::vec4 under(glm::vec3(background) * background.w, background.w);
    Block block{};
    for (std::size_t i = 0; i < block.size(); ++i)
        block[i] = under[static_cast<int>(i % 4)];
    return block;
}

float sameFloat(float value) { return value; }

template <typename Value, Value (*stored)(float)>
void resolveBlock(const float* from, const Block& under, Value* to) {
    Block seen;
    for (std::size_t i = 0; i < kBlockValues; ++i)
        seen[i] = 1.0F - from[i / 4 * 4 + 3];
    for (std::size_t i = 0; i < kBlockValues; ++i)
        to[i] = stored(from[i] + seen[i] * under[i]);
}

template <typename Value, Value (*stored)(float)>
std::vector<Value> resolved(const std::vector<float>& drawn, glm::ivec2 sizePixels,
                            const glm::vec4& background) {
    const Block under = blockOf(background);
    const auto rowValues = static_cast<std::size_t>(sizePixels.x) * 4;
    const auto rows = static_cast<std::size_t>(sizePixels.y);
    std::vector<Value> picture(rowValues * rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const float* from = drawn.data() + (rows - 1 - row) * rowValues;
        Value* to = picture.data() + row * rowValues;
        std::size_t i = 0;
        for (; i + kBlockValues <= rowValues; i += kBlockValues)
            resolveBlock<Value, stored>(from + i, under, to + i);
        for (; i < rowValues; ++i)
            to[i] = stored(from[i] + (1.0F - from[i / 4 * 4 + 3]) * under[i % 4]);
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
