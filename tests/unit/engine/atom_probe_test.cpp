// Which atom a ray meets first.
#include "engine/atom_probe.h"

#include "volume/clip_shapes.h"
#include "volume/elements.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

const double kRadius = elementOf(6).covalentRadius;

/// Carbon at z = 0, oxygen in front of it at z = 5; the eye looks down from z = 10.
struct AtomProbe : testing::Test {
    AtomProbe() {
        sites.sites = {{6, glm::dvec3(0.0)}, {8, glm::dvec3(0.0, 0.0, 5.0)}};
        tile.crystal.atoms = true;
        tile.crystal.radiusScale = 1.0;
    }
    [[nodiscard]] int under(double x) const {
        const auto hit =
            atomUnderRay(tile, sites, {{x, 0.0, 10.0}, {0.0, 0.0, -1.0}}, object ? &*object : nullptr);
        return hit ? hit->atomicNumber : 0;
    }
    /// A ball about a point.
    void clipWith(ClipMode mode, const glm::dvec3& centre, double radius) {
        const DatasetMeta meta = clipShapeMeta(ClipShape::Sphere);
        auto samples = std::make_shared<LevelSamples>();
        samples->dims = meta.grid.dims;
        samples->values = clipShapeSamples(ClipShape::Sphere);
        object = ObjectSamples{meta.grid, samples};
        ClipObject clip{meta.key, glm::dmat4(1.0 / radius), mode, false};
        clip.objectFromWorld[3] = glm::dvec4(-centre / radius, 1.0);
        tile.clip.object = clip;
    }
    CrystalSites sites;
    TileSpec tile;
    std::optional<ObjectSamples> object;
};

TEST_F(AtomProbe, TheNearestSphereIsTheOneThatIsSeen) {
    EXPECT_EQ(under(0.0), 8);
    const auto hit = atomUnderRay(tile, sites, {{0.0, 0.0, 10.0}, {0.0, 0.0, -1.0}}, nullptr);
    EXPECT_NEAR(hit.value().depth, 5.0 - elementOf(8).covalentRadius, 1e-12);
    EXPECT_EQ(hit->centreWorld, glm::dvec3(0.0, 0.0, 5.0));
    // Carbon is the larger one and stands out beside it.
    ASSERT_GT(kRadius, elementOf(8).covalentRadius);
    EXPECT_EQ(under(0.999 * kRadius), 6);
    EXPECT_EQ(under(1.001 * kRadius), 0);
    EXPECT_FALSE(atomUnderRay(tile, sites, {{0.0, 0.0, -9.0}, {0.0, 0.0, -1.0}}, nullptr))
        << "behind the eye";
    tile.crystal.atoms = false;
    EXPECT_EQ(under(0.0), 0);
}

TEST_F(AtomProbe, WhatAClipPlaneRemovesIsNotSeen) {
    tile.clip.planes = {{glm::dvec3(0.0, 0.0, -1.0), -4.0}}; // keeps z <= 4
    EXPECT_EQ(under(0.0), 6);
}

TEST_F(AtomProbe, WhatAClipObjectRemovesIsNotSeen) {
    const glm::dvec3 oxygen(0.0, 0.0, 5.0);
    clipWith(ClipMode::Clip, oxygen, 2.0); // removes what is inside
    EXPECT_EQ(under(0.0), 6);
    clipWith(ClipMode::Probe, oxygen, 2.0); // keeps only that
    EXPECT_EQ(under(0.0), 8);
    EXPECT_EQ(under(0.999 * kRadius), 0) << "the carbon atom is outside";
    tile.technique = Technique::Plane;
    tile.plane.offset = 0.0;
    EXPECT_EQ(under(0.0), 6) << "planes are not clipped";
}

TEST_F(AtomProbe, APlaneShowsTheDiscsThatItCuts) {
    tile.technique = Technique::Plane;
    tile.plane.offset = 5.0;
    EXPECT_EQ(under(0.0), 8);
    tile.plane.offset = 0.9 * kRadius;
    EXPECT_EQ(under(0.0), 6);
    EXPECT_EQ(under(0.5 * kRadius), 0) << "the disc is smaller than the sphere";
    tile.plane.offset = 2.5;
    EXPECT_EQ(under(0.0), 0);
}

} // namespace
} // namespace voxsheet::engine
