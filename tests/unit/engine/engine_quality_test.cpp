#include "engine_fixture.h"

#include <set>

namespace voxsheet::engine {
namespace {

TEST_F(EngineTest, ATileAtAnotherQualityIsTheOneThatIsPreparedAtIt) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {40, 40, 40}, 10)), request(volume("b.nrrd", {16, 8, 8}, 40))});
    ASSERT_TRUE(engine.waitIdle(60));
    const auto text = [](const char* value) { return sheet::StyleValue{std::string(value)}; };
    const std::vector<sheet::StyleMap> styles{
        {},
        {{"level", std::int64_t{1}}, {"sampling.distance", 0.25}},
        {{"technique", text("mip")}, {"annotations", text("all")}},
        {{"technique", text("plane")}, {"overlay.dataset", text("B1")}},
        {{"technique", text("isosurface")}, {"isosurface.colorBy", text("B1")}},
        {{"technique", text("isosurface")}, {"isovalue", sheet::NumberTable{{{500.0}}}}},
        {{"layers", text("B1")}, {"layers.weights", sheet::NumberTable{{{0.5}, {0.25}}}}},
        {{"clip.shape", text("sphere")}, {"shading.model", text("phong")}},
        {{"labels.show", text("on")}, {"technique", text("raycast")}},
        {{"range.mode", text("shared")}, {"camera.frame", text("world")}},
        {{"crystal.atoms", text("on")}},
    };
    TileQuality full;
    full.sizePixels = {160, 100};
    full.live = true;
    full.crosshair = true;
    TileQuality reduced = full;
    reduced.sizePixels = {40, 25};
    reduced.sampleDistanceFactor = 3.0;
    std::set<std::string> identities;
    for (const sheet::StyleMap& style : styles) {
        View view;
        view.all = style;
        const auto prepare = [&](const TileQuality& quality) {
            return engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, quality);
        };
        const std::string named = style.empty() ? "no style" : style.begin()->first;
        const PreparedTile tile = prepare(full);
        const PreparedTile wanted = prepare(reduced);
        ASSERT_TRUE(tile.spec && wanted.spec) << named << ": " << tile.message;
        const PreparedTile again = engine.atQuality(tile, reduced);
        EXPECT_EQ(again.cell, wanted.cell);
        EXPECT_EQ(again.identity, wanted.identity) << named;
        EXPECT_NE(again.identity, tile.identity) << named;
        EXPECT_EQ(again.spec->sizePixels, wanted.spec->sizePixels);
        EXPECT_EQ(again.spec->sampleDistanceVoxels, wanted.spec->sampleDistanceVoxels) << named;
        EXPECT_EQ(again.note, wanted.note) << named;
        EXPECT_EQ(again.code + again.message, "") << named;
        EXPECT_EQ(again.progress, wanted.progress);
        EXPECT_EQ(again.needs.work, wanted.needs.work) << named;
        EXPECT_EQ(again.needs.texelEdgePixels, wanted.needs.texelEdgePixels) << named;
        EXPECT_EQ(again.needs.textureBytes, wanted.needs.textureBytes) << named;
        EXPECT_EQ(again.needs.further.size(), wanted.needs.further.size()) << named;
        EXPECT_EQ(again.needs.pinned, wanted.needs.pinned) << named;
        EXPECT_EQ(again.colourVolumeLevels, wanted.colourVolumeLevels) << named;
        EXPECT_EQ(again.layerLevels, wanted.layerLevels) << named;
        EXPECT_EQ(engine.atLevel(again, 1).identity, engine.atLevel(wanted, 1).identity) << named;
        EXPECT_EQ(engine.atQuality(again, full).identity, tile.identity) << named << ": and back";
        identities.insert(again.identity);
    }
    EXPECT_EQ(identities.size(), styles.size() - 1) << "atoms that the data lack change the note alone";
}

} // namespace
} // namespace voxsheet::engine
