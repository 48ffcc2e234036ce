// Each random tile must agree with the truth, and must not change when empty space is not skipped or the
// shader filters for itself.
#include "fields/hit_map.h"
#include "image/random_tiles.h"

namespace voxsheet::image {
namespace {

constexpr int kTiles = 10; ///< per technique; 150 were drawn once

/// Pixels that a 32-bit float may decide differently: edges of faces and of voxels of binary objects, samples
/// just within a voxel of a cut.
constexpr double kUndecided = 0.006;

/// Pixels in which two neighbouring surfaces or edges meet, or where one surface is crossed twice within a
/// step.
std::vector<bool> undecidedPixels(const TileSpec& tile, const Grid& grid, const fields::Sources& sources) {
    const double jump = 3.0 * meanVoxelEdgeWorld(grid);
    if (tile.technique == Technique::Surface)
        return fields::silhouettes(fields::faceHits(tile, sources), tile.sizePixels, jump);
    if (tile.technique != Technique::Isosurface) return {};
    const auto hits = fields::isosurfaceHits(tile, sources);
    auto undecided = fields::silhouettes(hits, tile.sizePixels, jump);
    for (std::size_t pixel = 0; pixel < hits.size(); ++pixel) {
        const auto x = static_cast<double>(pixel % static_cast<std::size_t>(tile.sizePixels.x));
        const auto y = static_cast<double>(pixel / static_cast<std::size_t>(tile.sizePixels.x));
        const fields::RayTruth ray(tile, sources, fields::worldRay(tile, x + 0.5, y + 0.5));
        const double step = tile.sampleDistanceVoxels / ray.voxelsPerDepth;
        for (std::size_t i = 1; i < hits[pixel].size(); ++i)
            if (hits[pixel][i].depth - hits[pixel][i - 1].depth < step) undecided[pixel] = true;
    }
    return undecided;
}

TEST_P(RandomTiles, AgreeWithTheTruthAndWithThemselves) {
    for (int trial = 0; trial < kTiles; ++trial) {
        const auto grid = randomGrid();
        const auto tile = randomTile(grid, trial);
        const auto name = std::to_string(trial) + " " + describe(tile, grid);
        SCOPED_TRACE(name);
        const auto picture = painter.draw(tile);
        painter.techniques().setEmptySpaceSkipping(false);
        const auto inEverySpace = painter.draw(tile);
        if (painter.filtersExactly())
            EXPECT_TRUE(picture.pixels == inEverySpace.pixels) << "skipping empty space changes the picture";
        else
            EXPECT_EQ(pixelsApart(picture, inEverySpace, 1e-4), 0U)
                << "skipping empty space changes the picture";
        painter.techniques().setEmptySpaceSkipping(true);
        painter.techniques().setShaderFiltering(true);
        const std::size_t mayDiffer = painter.filtersExactly() ? 0 : picture.pixels.size() / 50;
        EXPECT_LE(pixelsApart(picture, painter.draw(tile), 1e-3), mayDiffer)
            << "the shader filters differently";
        painter.techniques().setShaderFiltering(false);
        // Long steps miss surfaces that they pass twice, wherever these are.
        if (GetParam() == Technique::Isosurface && tile.sampleDistanceVoxels > 0.6) continue;
        const auto sources = fields::sourcesOf(painter.provider(), tile);
        const auto apart = pixelsApart(picture, fields::insidePicture(tile, sources), 0.01,
                                       undecidedPixels(tile, grid, sources));
        std::printf("%3zu of %4zu pixels apart: %s\n", apart, picture.pixels.size(), name.c_str());
        EXPECT_LE(static_cast<double>(apart), 2.0 + kUndecided * static_cast<double>(picture.pixels.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(All, RandomTiles,
                         testing::Values(Technique::Raycast, Technique::Slices, Technique::Mip,
                                         Technique::Surface, Technique::Isosurface),
                         [](const testing::TestParamInfo<Technique>& tile) {
                             return fields::nameOf(tile.param);
                         });

} // namespace
} // namespace voxsheet::image
