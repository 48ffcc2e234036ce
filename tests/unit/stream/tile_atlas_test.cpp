// Many pictures in one: nothing overlaps, nothing is lost, and an encoder that works in blocks sees what it
// would see alone.
#include "stream/encoder.h"
#include "stream/tile_atlas.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <memory>
#include <random>

namespace {

using namespace voxsheet;
using namespace voxsheet::stream;

TilePixels picture(glm::ivec2 size, unsigned seed) {
    TilePixels pixels;
    pixels.size = size;
    std::mt19937 random(seed);
    const unsigned grey = random() % 256;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (const int value : {x * 3, y * 5, static_cast<int>(grey), 255})
                pixels.rgba8.push_back(static_cast<unsigned char>(value));
    return pixels;
}

std::vector<unsigned char> partOf(const TilePixels& atlas, glm::ivec2 origin, glm::ivec2 size) {
    std::vector<unsigned char> part;
    for (int y = 0; y < size.y; ++y) {
        const auto first = atlas.rgba8.begin() + 4 * ((origin.y + y) * atlas.size.x + origin.x);
        part.insert(part.end(), first, first + 4 * size.x);
    }
    return part;
}

TilePixels decoded(const std::string& jpeg) {
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
    const auto* data = reinterpret_cast<const unsigned char*>(jpeg.data());
    TilePixels pixels;
    int subsampling = 0;
    tjDecompressHeader2(decoder.get(), const_cast<unsigned char*>(data), jpeg.size(), &pixels.size.x,
                        &pixels.size.y, &subsampling);
    pixels.rgba8.resize(4 * static_cast<std::size_t>(pixels.size.x) *
                        static_cast<std::size_t>(pixels.size.y));
    // Plain chroma: a smooth one mixes neighbouring blocks.
    tjDecompress2(decoder.get(), data, jpeg.size(), pixels.rgba8.data(), pixels.size.x, 0, pixels.size.y,
                  TJPF_RGBA, TJFLAG_FASTUPSAMPLE);
    return pixels;
}

TEST(TileAtlas, HoldsEveryPictureWhole) {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        std::vector<TilePixels> pictures;
        std::vector<glm::ivec2> sizes;
        std::vector<const TilePixels*> pointers;
        for (unsigned i = 0; i < 1 + random() % 70; ++i) {
            pictures.push_back(picture({1 + random() % 90, 1 + random() % 60}, i));
            sizes.push_back(pictures.back().size);
        }
        for (const auto& each : pictures)
            pointers.push_back(&each);
        const auto layout = layOutAtlas(sizes);
        ASSERT_EQ(layout.origins.size(), pictures.size());
        const auto atlas = composeAtlas(pointers, layout);
        // Pictures that overlapped would overwrite each other.
        for (std::size_t i = 0; i < pictures.size(); ++i)
            EXPECT_EQ(partOf(atlas, layout.origins[i], sizes[i]), pictures[i].rgba8) << "picture " << i;
    }
}

TEST(TileAtlas, IsAboutAsWideAsHigh) {
    const auto layout = layOutAtlas(std::vector<glm::ivec2>(64, glm::ivec2(80, 48)));
    EXPECT_LT(layout.size.x, 2 * layout.size.y);
    EXPECT_LT(layout.size.y, 2 * layout.size.x);
}

TEST(TileAtlas, AJpegOfItHasTheSamePixelsAsOneOfEachPicture) {
    EncodeSettings settings;
    settings.format = ImageFormat::Jpeg;
    settings.quality = 75;
    settings.subsampleChroma = true;
    const std::vector<TilePixels> pictures{picture({75, 46}, 1), picture({16, 16}, 2), picture({33, 17}, 3)};
    const auto layout = layOutAtlas({pictures[0].size, pictures[1].size, pictures[2].size});
    const auto atlas =
        decoded(encodeImage(composeAtlas({&pictures[0], &pictures[1], &pictures[2]}, layout), settings));
    ASSERT_EQ(atlas.size, layout.size);
    for (std::size_t i = 0; i < pictures.size(); ++i)
        EXPECT_EQ(partOf(atlas, layout.origins[i], pictures[i].size),
                  decoded(encodeImage(pictures[i], settings)).rgba8)
            << "picture " << i;
}

TEST(TileAtlas, WorkIsSplitEvenly) {
    EXPECT_TRUE(splitEvenly({}, 2, 100).empty());
    EXPECT_EQ(splitEvenly({50, 50}, 2, 100), (std::vector<std::size_t>{2}));
    EXPECT_EQ(splitEvenly({100, 100, 100, 100}, 2, 100), (std::vector<std::size_t>{2, 4}));
    EXPECT_EQ(splitEvenly({1000, 10, 10}, 2, 100), (std::vector<std::size_t>{1, 3}));
    EXPECT_EQ(splitEvenly({1000}, 4, 100), (std::vector<std::size_t>{1}));
}

} // namespace
