#include "volume/host_texels.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

namespace voxsheet {
namespace {

constexpr glm::ivec3 kDims(3, 2, 4);

HostTexels numbered(glm::bvec3 periodic) {
    HostTexels texels(TexelFormat::R16, kDims, periodic);
    std::vector<std::uint16_t> values(3 * 2 * 4);
    std::iota(values.begin(), values.end(), std::uint16_t{100});
    const auto bytes = std::as_bytes(std::span(values));
    texels.setSlices(2, 2, bytes.subspan(2 * 12)); // in any order
    texels.setSlices(0, 2, bytes.subspan(0, 2 * 12));
    texels.closeBorders();
    return texels;
}

int at(const HostTexels& texels, glm::ivec3 place) {
    const auto texel = static_cast<std::size_t>(place.z + 1) * texels.sliceTexels() +
                       static_cast<std::size_t>(place.y + 1) * texels.rowTexels() +
                       static_cast<std::size_t>(place.x + 1);
    std::uint16_t value = 0;
    std::memcpy(&value, texels.first() + 2 * texel, sizeof value);
    return value;
}

int expected(glm::ivec3 place, glm::bvec3 periodic) {
    for (int axis = 0; axis < 3; ++axis) {
        const int n = kDims[axis];
        place[axis] = periodic[axis] ? (place[axis] + n) % n : std::min(std::max(place[axis], 0), n - 1);
    }
    return 100 + (place.z * kDims.y + place.y) * kDims.x + place.x;
}

TEST(HostTexels, BordersRepeatTheEndsOrWrap) {
    for (int axes = 0; axes < 8; ++axes) {
        const glm::bvec3 periodic((axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0);
        const auto texels = numbered(periodic);
        for (int z = -1; z <= kDims.z; ++z)
            for (int y = -1; y <= kDims.y; ++y)
                for (int x = -1; x <= kDims.x; ++x)
                    ASSERT_EQ(at(texels, {x, y, z}), expected({x, y, z}, periodic))
                        << x << " " << y << " " << z;
    }
}

TEST(HostTexels, CountsItsBorderAndWhatMayBeReadBehindIt) {
    EXPECT_EQ(HostTexels::bytesFor(TexelFormat::R16, kDims), 5U * 4 * 6 * 2 + HostTexels::kSlackBytes);
}

TEST(HostTexels, RefusesWhatOffsetsCannotReach) {
    EXPECT_TRUE(HostTexels::fits({1288, 1288, 1288}));
    EXPECT_FALSE(HostTexels::fits({1290, 1290, 1290}));
    EXPECT_THROW(HostTexels(TexelFormat::R8, {2048, 2048, 2048}, glm::bvec3(false)), LimitExceeded);
}

TEST(HostTexels, RefusesSlicesOfAnotherSize) {
    HostTexels texels(TexelFormat::R8, kDims, glm::bvec3(false));
    EXPECT_THROW(texels.setSlices(0, 1, std::vector<std::byte>(5)), InternalError);
}

} // namespace
} // namespace voxsheet
