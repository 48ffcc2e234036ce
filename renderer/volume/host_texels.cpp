#include "volume/host_texels.h"

#include "base/byte_size.h"
#include "base/errors.h"

#include <cstring>
#include <limits>
#include <new>
#include <string>

namespace voxsheet {

HostTexels::HostTexels(TexelFormat format, glm::ivec3 dims, glm::bvec3 periodic)
    : format_(format), dims_(dims), periodic_(periodic) {
    const std::string what = "a volume of " + std::to_string(dims.x) + " x " + std::to_string(dims.y) +
                             " x " + std::to_string(dims.z) + " samples";
    if (!fits(dims))
        throw LimitExceeded(what, "rays are marched through at most 2^31 samples of one level",
                            "draw a coarser level");
    try {
        texels_ = HugePageBlock(bytesFor(format, dims));
    } catch (const std::bad_alloc&) {
        throw LimitExceeded(what, "this machine has no room for its " + byteText(bytesFor(format, dims)),
                            "draw a coarser level, or lower --texture-budget");
    }
    std::memset(texels_.data() + texels_.size() - kSlackBytes, 0, kSlackBytes);
}

std::uint64_t HostTexels::bytesFor(TexelFormat format, glm::ivec3 dims) {
    const auto padded = glm::tvec3<std::uint64_t>(dims) + std::uint64_t{2};
    return padded.x * padded.y * padded.z * texelFormatBytes(format) + kSlackBytes;
}

bool HostTexels::fits(glm::ivec3 dims) {
    const auto padded = glm::tvec3<std::uint64_t>(dims) + std::uint64_t{2};
    return padded.x * padded.y * padded.z < std::uint64_t{std::numeric_limits<std::int32_t>::max()};
}

std::byte* HostTexels::row(int y, int z) {
    const auto texel =
        static_cast<std::size_t>(z + 1) * sliceTexels() + static_cast<std::size_t>(y + 1) * rowTexels();
    return texels_.data() + texel * texelFormatBytes(format_);
}

void HostTexels::closeRow(std::byte* row) const {
    const std::size_t bytes = texelFormatBytes(format_);
    const std::size_t last = static_cast<std::size_t>(dims_.x);
    std::memcpy(row, row + (periodic_.x ? last : 1) * bytes, bytes);
    std::memcpy(row + (last + 1) * bytes, row + (periodic_.x ? 1 : last) * bytes, bytes);
}

void HostTexels::setSlices(int zBegin, int count, std::span<const std::byte> texels) {
    const std::size_t rowBytes = static_cast<std::size_t>(dims_.x) * texelFormatBytes(format_);
    if (texels.size() != rowBytes * static_cast<std::size_t>(dims_.y) * static_cast<std::size_t>(count))
        throw InternalError("slices of a volume", "they have the wrong size");
    const std::byte* in = texels.data();
    for (int z = zBegin; z < zBegin + count; ++z) {
        for (int y = 0; y < dims_.y; ++y, in += rowBytes) {
            std::memcpy(row(y, z) + texelFormatBytes(format_), in, rowBytes);
            closeRow(row(y, z));
        }
        const std::size_t padded = rowTexels() * texelFormatBytes(format_);
        std::memcpy(row(-1, z), row(periodic_.y ? dims_.y - 1 : 0, z), padded);
        std::memcpy(row(dims_.y, z), row(periodic_.y ? 0 : dims_.y - 1, z), padded);
    }
}

void HostTexels::closeBorders() {
    const std::size_t padded = sliceTexels() * texelFormatBytes(format_);
    std::memcpy(row(-1, -1), row(-1, periodic_.z ? dims_.z - 1 : 0), padded);
    std::memcpy(row(-1, dims_.z), row(-1, periodic_.z ? 0 : dims_.z - 1), padded);
}

} // namespace voxsheet
