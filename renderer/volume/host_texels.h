// A volume's texels in host memory, with a border of one texel, for techniques that run on the processor.
#pragma once

#include "base/huge_page_block.h"
#include "volume/texture_encoding.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace voxsheet {

/// Texel (x, y, z) of -1 <= x, y, z <= dims lies at
///   first() + ((z + 1) sliceTexels + (y + 1) rowTexels + (x + 1)) texelFormatBytes(format).
/// What lies beyond the samples repeats the nearest one, or wraps on periodic axes: interpolation between
/// neighbours then needs no test for ends. Behind the last texel lie kSlackBytes more that may be read.
class HostTexels {
public:
    static constexpr std::size_t kSlackBytes = 64;

    /// Throws LimitExceeded if !fits(dims), or if there is no room.
    HostTexels(TexelFormat format, glm::ivec3 dims, glm::bvec3 periodic);

    /// Slices [zBegin, zBegin + count), tightly packed, x fastest: texels.size() = dims.x * dims.y * count *
    /// texelFormatBytes(format). Throws InternalError otherwise. Every slice must come once.
    void setSlices(int zBegin, int count, std::span<const std::byte> texels);
    /// After the last slice.
    void closeBorders();

    [[nodiscard]] const std::byte* first() const { return texels_.data(); }
    [[nodiscard]] TexelFormat format() const { return format_; }
    [[nodiscard]] glm::ivec3 dims() const { return dims_; }
    [[nodiscard]] glm::bvec3 periodic() const { return periodic_; }
    [[nodiscard]] std::size_t rowTexels() const { return static_cast<std::size_t>(dims_.x) + 2; }
    [[nodiscard]] std::size_t sliceTexels() const {
        return rowTexels() * (static_cast<std::size_t>(dims_.y) + 2);
    }

    /// What the texels of such a volume take.
    [[nodiscard]] static std::uint64_t bytesFor(TexelFormat format, glm::ivec3 dims);
    /// Offsets of texels fit 32 bits, as the kernels count them.
    [[nodiscard]] static bool fits(glm::ivec3 dims);

private:
    [[nodiscard]] std::byte* row(int y, int z);
    void closeRow(std::byte* row) const;

    TexelFormat format_;
    glm::ivec3 dims_;
    glm::bvec3 periodic_;
    HugePageBlock texels_;
};

} // namespace voxsheet
