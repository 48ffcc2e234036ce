// Ranges of what a picture shows: values are their own voxel's coordinates, so that each bound is known.
#include "engine/visible_range.h"

#include "memory_dataset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace voxsheet::engine {
namespace {

constexpr int kEdge = 9;

/// Values i + 10 j + 100 k of 9^3 samples, one apart, from (0, 0, 0).
class VisibleRange : public testing::Test {
protected:
    VisibleRange() {
        test::addDataset(provider, test::metaOf("v", glm::ivec3(kEdge)), [](int i, int j, int k) {
            return i == 4 && j == 4 && k == 8 ? std::numeric_limits<float>::quiet_NaN()
                                              : static_cast<float>(i + 10 * j + 100 * k);
        });
        tile.dataset = "v";
        tile.transfer = std::make_shared<const TransferTable>();
        // Looks down along -z at the middle (4, 4); 18 units are in the picture's height.
        tile.camera.projection = Projection::Orthographic;
        tile.camera.heightWorld = 18.0;
        tile.camera.viewFromWorld[3] = glm::dvec4(-4.0, -4.0, -50.0, 1.0);
        tile.sizePixels = {100, 100};
    }

    std::optional<ValueExtremes> range() {
        return visibleRange(tile, *provider.describe("v"), provider, nullptr);
    }

    MemoryVolumeProvider provider;
    TileSpec tile;
};

TEST_F(VisibleRange, AllOfAVolumeThatFits) { EXPECT_EQ(range(), (ValueExtremes{0.0, 888.0})); }

TEST_F(VisibleRange, OnlyWhatLiesWithinThePicturesEdges) {
    tile.camera.heightWorld = 5.0; // 1.5 to 6.5 in x and y
    EXPECT_EQ(range(), (ValueExtremes{22.0, 866.0}));
    tile.sizePixels = {50, 100}; // half as wide: 2.75 to 5.25 in x
    EXPECT_EQ(range(), (ValueExtremes{23.0, 865.0}));
    tile.camera.viewFromWorld[3].x = 500.0;
    EXPECT_EQ(range(), std::nullopt) << "nothing is in the picture";
}

TEST_F(VisibleRange, PerspectiveSeesLessOfWhatIsNear) {
    tile.camera.projection = Projection::Perspective;
    tile.camera.fovYDegrees = 90.0;
    tile.camera.viewFromWorld[3].z = -9.5; // The eye is 9.5 above z = 0 and 1.5 above z = 8.
    // At z = 8 it sees 2.5 to 5.5, at z = 6 and deeper 0.5 to 7.5 and more; z = 0 whole.
    EXPECT_EQ(range(), (ValueExtremes{0.0, 855.0}));
    tile.camera.viewFromWorld[3].z = -7.5; // Inside: what lies behind the eye is not seen.
    EXPECT_EQ(range(), (ValueExtremes{0.0, 744.0})) << "at z = 7, half a unit away, only (4, 4) is";
}

TEST_F(VisibleRange, AnAxialPlaneOnSamplesShowsTheseAlone) {
    tile.technique = Technique::Plane;
    tile.plane.normal = {0.0, 0.0, 1.0};
    tile.plane.offset = 3.0;
    EXPECT_EQ(range(), (ValueExtremes{300.0, 388.0}));
    tile.plane.offset = 3.25; // Between samples both sides take part, with nearest one.
    EXPECT_EQ(range(), (ValueExtremes{300.0, 488.0}));
    tile.plane.interpolation = PlaneInterpolation::Nearest;
    EXPECT_EQ(range(), (ValueExtremes{300.0, 388.0}));
    tile.plane.offset = 12.0;
    EXPECT_EQ(range(), std::nullopt);
}

TEST_F(VisibleRange, ClipPlanesLeaveOutWhatTheyRemove) {
    tile.clip.planes = {{{0.0, 0.0, -1.0}, -2.5}}; // keeps z <= 2.5
    EXPECT_EQ(range(), (ValueExtremes{0.0, 288.0}));
}

TEST_F(VisibleRange, SamplesWithoutAValueDoNotCount) {
    tile.technique = Technique::Plane;
    tile.plane.normal = {0.0, 0.0, 1.0};
    tile.plane.offset = 8.0;
    tile.camera.heightWorld = 0.5; // Only (4, 4, 8), which is NaN.
    EXPECT_EQ(range(), std::nullopt);
}

TEST_F(VisibleRange, PeriodicVolumesShowTheirSamplesWhereTheWindowPutsThem) {
    DatasetMeta meta = test::metaOf("p", glm::ivec3(kEdge));
    meta.grid.periodic = glm::bvec3(true);
    test::addDataset(provider, meta,
                     [](int i, int j, int k) { return static_cast<float>(i + 10 * j + 100 * k); });
    tile.camera.heightWorld = 3.0; // 2.5 to 5.5 in x and y: samples 3, 4, 5
    EXPECT_EQ(visibleRange(tile, *provider.describe("p"), provider, nullptr), (ValueExtremes{33.0, 855.0}));
    tile.periodic.shift = {3.0 / kEdge, 0.0, 0.0}; // What stood at 0, 1, 2 stands there now.
    EXPECT_EQ(visibleRange(tile, *provider.describe("p"), provider, nullptr), (ValueExtremes{30.0, 852.0}));
    tile.camera.viewFromWorld[3].x = -13.0; // One period further: drawn only if there are two.
    EXPECT_EQ(visibleRange(tile, *provider.describe("p"), provider, nullptr), std::nullopt);
    tile.periodic.replicate = {2, 1, 1};
    EXPECT_EQ(visibleRange(tile, *provider.describe("p"), provider, nullptr), (ValueExtremes{30.0, 852.0}));
}

} // namespace
} // namespace voxsheet::engine
