#include "frame/host_resolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet {
namespace {

TEST(HostResolver, RoundsToTheNearestByteAndTiesToTheEvenOne) {
    std::vector<float> drawn;
    std::vector<unsigned char> expected;
    const auto add = [&](float value) {
        drawn.push_back(value);
        const float part = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
        expected.push_back(static_cast<unsigned char>(std::lrintf(part * 255.0F)));
    };
    for (int half = 0; half <= 510; ++half) { // each byte, each tie, and the floats next to them
        const float value = static_cast<float>(half) / 510.0F;
        add(value);
        add(std::nextafter(value, -1.0F));
        add(std::nextafter(value, 2.0F));
    }
    while (drawn.size() % 4 != 0)
        add(0.0F);
    // Whole pixels from here on: what is not finite must not be an alpha.
    for (const float value : {-1.0F, 1.5F, std::numeric_limits<float>::infinity(), 0.0F,
                              std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F, 0.0F})
        add(value);
    EXPECT_EQ(resolvedRgba8(drawn, {static_cast<int>(drawn.size() / 4), 1}, glm::vec4(0.0F)), expected);
}

TEST(HostResolver, TurnsRowsOverAndBlendsTheBackgroundUnderThem) {
    const std::vector<float> drawn{0.25F, 0.0F, 0.0F, 0.5F, 0.0F, 1.0F, 0.0F, 1.0F}; // bottom row first
    const std::vector<float> expected{0.0F, 1.0F, 0.0F, 1.0F, 0.25F, 0.25F, 0.0F, 0.75F};
    EXPECT_EQ(resolvedRgba32f(drawn, {1, 2}, {0.0F, 1.0F, 0.0F, 0.5F}), expected);
}

} // namespace
} // namespace voxsheet
