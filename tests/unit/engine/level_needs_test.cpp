#include "engine/level_needs.h"

#include "memory_dataset.h"
#include "volume/host_texels.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

TEST(LevelNeeds, AFurtherVolumeIsNamedAndSizedAsTheCellThatShowsIt) {
    const DatasetMeta meta = test::metaOf("b", {64, 32, 16});
    TileSpec tile;
    tile.dataset = "b";
    const LevelNeeds own = levelNeeds(tile, meta, {}, {});
    const FurtherVolume further = furtherVolume(meta, 0, 0, {FloatTexels::Full, false}, {});
    EXPECT_EQ(further.volume, own.volume);
    EXPECT_EQ(further.textureBytes, own.textureBytes);
    ASSERT_EQ(further.textureBytes.size(), static_cast<std::size_t>(meta.levels()));
    EXPECT_EQ(further.textureBytes.at(0), 64U * 32 * 16 * 4) << "float texels";
    EXPECT_TRUE(own.further.empty());
    const FurtherVolume half = furtherVolume(meta, 0, 0, {FloatTexels::Half, false}, {});
    EXPECT_NE(half.volume, further.volume) << "another texture";
    EXPECT_EQ(half.textureBytes.at(0), 64U * 32 * 16 * 2);
}

TEST(LevelNeeds, AGradientTextureIsTheDrawnVolumesOwn) {
    const DatasetMeta meta = test::metaOf("b", {64, 32, 16});
    TileSpec tile;
    tile.dataset = "b";
    tile.shading.enabled = true;
    tile.shading.gradient = GradientSource::Texture;
    const LevelNeeds lit = levelNeeds(tile, meta, {}, {});
    EXPECT_EQ(lit.textureBytes.at(0), 64U * 32 * 16 * (4 + 8));
}

TEST(LevelNeeds, VolumesThatRaysReadAreCountedInHostMemoryWhereTheProcessorMarches) {
    const DatasetMeta meta = test::metaOf("b", {64, 32, 16});
    DeviceForms simd;
    simd.paths.set(Technique::Raycast, RenderPath::Simd);
    TileSpec tile;
    tile.dataset = "b";
    tile.shading.enabled = true;
    tile.shading.gradient = GradientSource::Texture;
    const LevelNeeds marched = levelNeeds(tile, meta, {}, simd);
    EXPECT_EQ(marched.textureBytes.at(0), 66U * 34 * 18 * 4 + HostTexels::kSlackBytes)
        << "a border of one, and no gradient texture";
    tile.technique = Technique::Slices;
    const LevelNeeds sliced = levelNeeds(tile, meta, {}, simd);
    EXPECT_EQ(sliced.textureBytes.at(0), 64U * 32 * 16 * (4 + 8));
    EXPECT_NE(sliced.volume, marched.volume);
}

TEST(LevelNeeds, AClipObjectStaysAtLevelZero) {
    const DatasetMeta distances = test::metaOf("d", {64, 32, 16});
    ASSERT_GT(distances.levels(), 1);
    const FurtherVolume object = clipObjectVolume(distances, false, {});
    EXPECT_EQ(object.textureBytes, (std::vector<std::uint64_t>{64U * 32 * 16 * 4}));
    EXPECT_EQ(object.volume, furtherVolume(distances, 0, 0, {FloatTexels::Full, false}, {}).volume)
        << "a cell that shows the distances shares the texture";
}

} // namespace
} // namespace voxsheet::engine
