// Many small pictures as few: what one frame changes is encoded, sent and decoded together.
#pragma once

#include "frame/frame_spec.h"

#include <cstddef>
#include <vector>

namespace voxsheet::stream {

/// JPEG with 4:2:0 chroma works in blocks of so many pixels: a picture that begins on such a block has the
/// same blocks as it would have alone.
inline constexpr int kAtlasBlockPixels = 16;

/// Where the pictures of an atlas lie, in the order in which they were given.
struct AtlasLayout {
    glm::ivec2 size{0};
    std::vector<glm::ivec2> origins; ///< upper left corners; multiples of kAtlasBlockPixels
};

/// Rows of pictures, about as wide as they are high together. Sizes are at least 1.
[[nodiscard]] AtlasLayout layOutAtlas(const std::vector<glm::ivec2>& sizes);

/// One rgba8 picture that holds all; edges are repeated to the ends of blocks, as encoders do it themselves
/// at the edge of a picture. Rgba8 pictures only.
[[nodiscard]] TilePixels composeAtlas(const std::vector<const TilePixels*>& pictures,
                                      const AtlasLayout& layout);

/// Splits pictures, by their numbers of pixels, into runs of neighbours with about as many pixels each: at
/// most `most`, and fewer where a run would have fewer than `leastPixels` on average. Returns the runs' ends.
[[nodiscard]] std::vector<std::size_t> splitEvenly(const std::vector<std::size_t>& pixels, std::size_t most,
                                                   std::size_t leastPixels);

} // namespace voxsheet::stream
