#include "stream/tile_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace voxsheet::stream {

namespace {

constexpr std::size_t kBytes = 4;

glm::ivec2 wholeBlocks(const glm::ivec2& size) {
    return (size + (kAtlasBlockPixels - 1)) / kAtlasBlockPixels * kAtlasBlockPixels;
}

/// With its last column and row repeated to the ends of their blocks.
void place(const TilePixels& picture, const glm::ivec2& origin, TilePixels& atlas) {
    const auto bytesOf = [](int pixels) { return static_cast<std::size_t>(pixels) * kBytes; };
    const glm::ivec2 taken = wholeBlocks(picture.size);
    const std::size_t stride = bytesOf(atlas.size.x);
    unsigned char* const first =
        atlas.rgba8.data() + static_cast<std::size_t>(origin.y) * stride + bytesOf(origin.x);
    for (int y = 0; y < picture.size.y; ++y) {
        const unsigned char* from =
            picture.rgba8.data() + static_cast<std::size_t>(y) * bytesOf(picture.size.x);
        unsigned char* to = first + static_cast<std::size_t>(y) * stride;
        std::memcpy(to, from, bytesOf(picture.size.x));
        for (int x = picture.size.x; x < taken.x; ++x)
            std::memcpy(to + bytesOf(x), to + bytesOf(picture.size.x - 1), kBytes);
    }
    const unsigned char* last = first + static_cast<std::size_t>(picture.size.y - 1) * stride;
    for (int y = picture.size.y; y < taken.y; ++y)
        std::memcpy(first + static_cast<std::size_t>(y) * stride, last, bytesOf(taken.x));
}

} // namespace

AtlasLayout layOutAtlas(const std::vector<glm::ivec2>& sizes) {
    double area = 0.0;
    int width = 0;
    for (const glm::ivec2& size : sizes) {
        const glm::ivec2 blocks = wholeBlocks(size);
        area += static_cast<double>(blocks.x) * blocks.y;
        width = std::max(width, blocks.x);
    }
    width = std::max(width, static_cast<int>(std::ceil(std::sqrt(area))));
    AtlasLayout layout;
    glm::ivec2 next(0);
    int rowHeight = 0;
    for (const glm::ivec2& size : sizes) {
        const glm::ivec2 blocks = wholeBlocks(size);
        if (next.x > 0 && next.x + blocks.x > width) {
            next = {0, next.y + rowHeight};
            rowHeight = 0;
        }
        layout.origins.push_back(next);
        next.x += blocks.x;
        rowHeight = std::max(rowHeight, blocks.y);
        layout.size = glm::max(layout.size, glm::ivec2(next.x, next.y + rowHeight));
    }
    return layout;
}

TilePixels composeAtlas(const std::vector<const TilePixels*>& pictures, const AtlasLayout& layout) {
    TilePixels atlas;
    atlas.size = layout.size;
    atlas.rgba8.resize(static_cast<std::size_t>(layout.size.x) * static_cast<std::size_t>(layout.size.y) *
                       kBytes);
    for (std::size_t i = 0; i < pictures.size(); ++i)
        place(*pictures[i], layout.origins[i], atlas);
    return atlas;
}

std::vector<std::size_t> splitEvenly(const std::vector<std::size_t>& pixels, std::size_t most,
                                     std::size_t leastPixels) {
    if (pixels.empty()) return {};
    const std::size_t sum = std::accumulate(pixels.begin(), pixels.end(), std::size_t{0});
    const std::size_t runs = std::clamp(sum / std::max<std::size_t>(leastPixels, 1), std::size_t{1},
                                        std::max<std::size_t>(most, 1));
    std::vector<std::size_t> ends;
    std::size_t taken = 0;
    for (std::size_t i = 0; i + 1 < pixels.size(); ++i) {
        taken += pixels[i];
        if (ends.size() + 1 < runs && taken * runs >= sum * (ends.size() + 1)) ends.push_back(i + 1);
    }
    ends.push_back(pixels.size());
    return ends;
}

} // namespace voxsheet::stream
