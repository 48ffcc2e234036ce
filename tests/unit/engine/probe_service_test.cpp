#include "engine/probe_service.h"

#include "engine/colour_map.h"
#include "engine/sample_reader.h"
#include "memory_dataset.h"
#include "volume/clip_shapes.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

constexpr int kEdge = 144; ///< more samples than are kept for rays: they read level 1

TEST(ProbeService, ACrossingFoundOnACoarseLevelIsMovedToLevel0s) {
    auto provider = std::make_shared<MemoryVolumeProvider>();
    // Means of cubes of a parabola lie 0.25 above it, a quarter of a voxel and more at this steepness.
    test::addDataset(*provider, test::metaOf("p", glm::ivec3(kEdge)),
                     [](int, int, int k) { return k < 20 ? static_cast<float>(k * k) : 400.0F; });
    const auto meta = provider->describe("p");
    const sheet::KeyTable keys = sheet::makeKeyTable(ColourMapTable::embedded().names());
    ProbeService probes(keys, provider);
    TileSpec tile;
    tile.dataset = "p";
    tile.technique = Technique::Isosurface;
    tile.isosurface.surfaces = {{1.75, glm::vec4(1.0F)}};
    tile.transfer = std::make_shared<const TransferTable>();
    tile.camera.projection = Projection::Orthographic;
    tile.camera.heightWorld = kEdge;
    tile.camera.viewFromWorld[3] = glm::dvec4(-70.0, -70.0, -500.0, 1.0);
    const auto hit = probes.underPixel(tile, *meta, {128, 128}, {});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->kind, HitKind::Isosurface);
    // Between 1 (k = 1) and 4 (k = 2); on level 1 it would be at 0.5 + 2 * 1.25 / 12 = 0.71.
    EXPECT_NEAR(hit->world.z, 1.25, 1e-5);

    tile.clip.object =
        ClipObject{clipShapeKey(ClipShape::Sphere), glm::dmat4(1.0 / 30.0), ClipMode::Clip, false};
    tile.clip.object->objectFromWorld[3] = glm::dvec4(-glm::dvec3(70.0, 70.0, 0.0) / 30.0, 1.0);
    const auto cut = probes.underPixel(tile, *meta, {128, 128}, {});
    ASSERT_TRUE(cut) << "distances of shapes need no store";
    EXPECT_EQ(cut->kind, HitKind::Middle);
}

TEST(ProbeService, VisibleValuesAreThoseThatTheClipObjectKeeps) {
    auto provider = std::make_shared<MemoryVolumeProvider>();
    test::addDataset(*provider, test::metaOf("v", glm::ivec3(9)),
                     [](int i, int j, int k) { return static_cast<float>(i + 10 * j + 100 * k); });
    const sheet::KeyTable keys = sheet::makeKeyTable(ColourMapTable::embedded().names());
    ProbeService probes(keys, provider);
    TileSpec tile;
    tile.dataset = "v";
    tile.transfer = std::make_shared<const TransferTable>();
    tile.camera.projection = Projection::Orthographic;
    tile.camera.heightWorld = 100.0;
    // A sphere of radius 2.5 about (4, 4, 4).
    tile.clip.object =
        ClipObject{clipShapeKey(ClipShape::Sphere), glm::dmat4(1.0 / 2.5), ClipMode::Probe, false};
    tile.clip.object->objectFromWorld[3] = glm::dvec4(-glm::dvec3(4.0) / 2.5, 1.0);
    EXPECT_EQ(probes.visible(tile, *provider->describe("v")), (ValueExtremes{233.0, 655.0}))
        << "two below and above the middle a circle of radius 1.5 is left";
    tile.clip.object->mode = ClipMode::Clip;
    EXPECT_EQ(probes.visible(tile, *provider->describe("v")), (ValueExtremes{0.0, 888.0}));
}

} // namespace
} // namespace voxsheet::engine
