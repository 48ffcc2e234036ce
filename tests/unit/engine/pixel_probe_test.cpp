#include "engine/pixel_probe.h"

#include "volume/clip_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace voxsheet::engine {
namespace {

constexpr double kNoCrossing = 1e-4; ///< of depths that are found by bisection, in voxels
const glm::dvec2 kMiddle(50, 50);

/// A cube of 33^3 samples at whole numbers, seen from +z; texels are `value` at their index.
struct Scene {
    explicit Scene(const std::function<double(const glm::dvec3&)>& value) {
        grid.dims = glm::ivec3(33);
        level.dims = grid.dims;
        for (int k = 0; k < 33; ++k)
            for (int j = 0; j < 33; ++j)
                for (int i = 0; i < 33; ++i)
                    level.values.push_back(static_cast<float>(value(glm::dvec3(i, j, k))));
        tile.camera.projection = Projection::Orthographic;
        tile.camera.heightWorld = 40.0;
        tile.camera.viewFromWorld[3] = glm::dvec4(-16.0, -16.0, -100.0, 1.0);
        tile.sizePixels = {100, 100};
        setOpacity(0.0, 0.0);
    }

    /// Opacities below and from value 0.5 on, linear between the two nearest entries.
    void setOpacity(float below, float above) {
        TransferTable table;
        for (int i = 0; i < 256; ++i)
            table.entries.emplace_back(1.0F, 1.0F, 1.0F, i >= 128 ? above : below);
        tile.transfer = std::make_shared<const TransferTable>(table);
    }

    void clipWith(ClipShape shape, ClipMode mode, double radius, const glm::dvec3& centre) {
        auto samples = std::make_shared<LevelSamples>();
        const DatasetMeta meta = clipShapeMeta(shape);
        samples->dims = meta.grid.dims;
        samples->values = clipShapeSamples(shape);
        object = ObjectSamples{meta.grid, samples};
        ClipObject clip{meta.key, glm::dmat4(1.0 / radius), mode, false};
        clip.objectFromWorld[3] = glm::dvec4(-centre / radius, 1.0);
        tile.clip.object = clip;
    }

    std::optional<PixelHit> hit(glm::dvec2 pixel = kMiddle, std::optional<double> opacity = {}) const {
        return pixelHit(tile, {grid, level, object ? &*object : nullptr}, pixel, opacity);
    }

    Grid grid;
    LevelSamples level;
    TileSpec tile;
    std::optional<ObjectSamples> object;
};

double constant(const glm::dvec3&) { return 1.0; }
double alongZ(const glm::dvec3& p) { return p.z; }

Scene isosurfaces(const std::function<double(const glm::dvec3&)>& value,
                  const std::vector<double>& isovalues) {
    Scene scene(value);
    scene.tile.technique = Technique::Isosurface;
    for (const double isovalue : isovalues)
        scene.tile.isosurface.surfaces.push_back({isovalue, glm::vec4(1.0F)});
    return scene;
}

TEST(PixelProbe, FindsTheSurfaceThatTheEyeSees) {
    Scene scene([](const glm::dvec3& p) { return p.z >= 6 && p.z <= 20 ? 1.0 : 0.0; });
    scene.setOpacity(0.0F, 0.99F);
    const auto hit = scene.hit();
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->kind, HitKind::Sample);
    EXPECT_NEAR(hit->world.x, 16.0, 1e-9);
    EXPECT_NEAR(hit->world.z, 20.25, 0.5) << "the side towards the eye";
}

TEST(PixelProbe, FallsBackToTheMiddleWhereNothingIsOpaque) {
    Scene scene(constant);
    const auto hit = scene.hit();
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->kind, HitKind::Middle);
    EXPECT_NEAR(hit->world.z, 16.0, 1e-9);
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, 1.0}, 20.0}};
    EXPECT_NEAR(scene.hit()->world.z, 20.0, 0.3) << "the kept point nearest to it";
    EXPECT_EQ(scene.hit()->kind, HitKind::Middle);
}

TEST(PixelProbe, AnOpacityOfItsOwnTakesTheFirstSampleThatReachesIt) {
    Scene scene(alongZ);
    TransferTable table;
    table.high = 32.0;
    for (int i = 0; i <= 32; ++i)
        table.entries.emplace_back(1.0F, 1.0F, 1.0F, static_cast<float>(i) / 32.0F);
    scene.tile.transfer = std::make_shared<const TransferTable>(table);
    scene.tile.camera.viewFromWorld = glm::dmat4(1.0); // From -z: opacity rises along the ray.
    scene.tile.camera.viewFromWorld[0][0] = -1.0;
    scene.tile.camera.viewFromWorld[2][2] = -1.0;
    scene.tile.camera.viewFromWorld[3] = glm::dvec4(16.0, -16.0, -100.0, 1.0);
    EXPECT_NEAR(scene.hit(kMiddle, 0.25)->world.z, 8.0, 0.5);
    EXPECT_NEAR(scene.hit(kMiddle, 0.75)->world.z, 24.0, 0.5);
    EXPECT_EQ(scene.hit(kMiddle, 0.75)->kind, HitKind::Sample);
    EXPECT_LT(scene.hit()->world.z, 8.0) << "accumulated opacity passes a half long before";
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, 1.0}, 28.0}};
    EXPECT_NEAR(scene.hit(kMiddle, 0.25)->world.z, 28.25, 0.3) << "only what is kept counts";
}

TEST(PixelProbe, SeesThePeriodsAndTheShiftThatThePictureShows) {
    Scene scene([](const glm::dvec3& p) { return p.z >= 6 && p.z <= 20 ? 1.0 : 0.0; });
    scene.grid.periodic = scene.level.periodic = glm::bvec3(true);
    scene.setOpacity(0.0F, 0.99F);
    scene.tile.periodic.shift.z = 5.0 / 33.0;
    EXPECT_NEAR(scene.hit()->world.z, 25.25, 0.5);
    scene.tile.periodic.replicate.z = 2;
    EXPECT_NEAR(scene.hit()->world.z, 25.25 + 33.0, 0.5) << "the second period is nearer to the eye";
    scene.tile.technique = Technique::Surface;
    EXPECT_NEAR(scene.hit()->world.z, 66.0, 1e-9) << "the face of the drawn box";
    scene.tile.technique = Technique::Plane;
    scene.tile.plane.offset = 50.0;
    EXPECT_NEAR(scene.hit().value().world.z, 50.0, 1e-9) << "beyond the first period";
}

TEST(PixelProbe, AMaximumProjectionAnswersWithTheLargestKeptValue) {
    Scene scene(alongZ);
    scene.tile.technique = Technique::Mip;
    EXPECT_NEAR(scene.hit()->world.z, 31.75, 1e-6);
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, -1.0}, -12.0}};
    EXPECT_NEAR(scene.hit()->world.z, 11.75, 0.3);
    EXPECT_EQ(scene.hit()->kind, HitKind::Sample);
    scene.clipWith(ClipShape::Sphere, ClipMode::Clip, 100.0, glm::dvec3(16.0));
    EXPECT_FALSE(scene.hit()) << "everything is cut away";
}

TEST(PixelProbe, APlaneIsHitWhereItCutsTheBoxWhateverIsClipped) {
    Scene scene(alongZ);
    scene.tile.technique = Technique::Plane;
    scene.tile.plane.offset = 20.0;
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, -1.0}, -10.0}};
    const auto hit = scene.hit({70, 50});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->kind, HitKind::Face);
    EXPECT_NEAR(hit->world.x, 24.0, 1e-9);
    EXPECT_NEAR(hit->world.y, 16.0, 1e-9);
    EXPECT_NEAR(hit->world.z, 20.0, 1e-9);
    EXPECT_FALSE(scene.hit({95, 50})) << "beside the box";
    scene.tile.plane.normal = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
    scene.tile.plane.offset = std::sqrt(0.5) * 30.0;
    EXPECT_NEAR(scene.hit({70, 50})->world.z, 6.0, 1e-9) << "x + z = 30";
    scene.tile.plane.normal = {1.0, 0.0, 0.0};
    EXPECT_FALSE(scene.hit()) << "edge-on";
    for (const double face : {0.0, 32.0}) {
        scene.tile.plane.normal = {0.0, 0.0, 1.0};
        scene.tile.plane.offset = face + (face > 0.0 ? 1e-12 : -1e-12);
        EXPECT_EQ(scene.hit()->world.z, face) << "rounding does not lift it off the box";
    }
}

TEST(PixelProbe, ARayBesideTheVolumeHitsNothing) {
    EXPECT_FALSE(Scene(constant).hit({-500, 50}));
    Scene cut(constant);
    cut.tile.clip.planes = {ClipPlane{{1.0, 0.0, 0.0}, 20.0}};
    EXPECT_FALSE(cut.hit()) << "cut away under the middle";
    EXPECT_TRUE(cut.hit({70, 50}));
}

TEST(PixelProbe, AnIsosurfaceIsHitAtTheRootOfTheInterpolant) {
    const auto ball = [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(16.0)); };
    const Scene scene = isosurfaces(ball, {5.0, 10.0});
    const auto hit = scene.hit();
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->kind, HitKind::Isosurface);
    EXPECT_EQ(hit->isovalue, 10.0);
    EXPECT_NEAR(hit->world.z, 26.0, kNoCrossing) << "along an axis of the grid the interpolant is exact";
    const auto beside = scene.hit({70, 50}); // 8 to the right: the interpolant is flatter than the ball.
    EXPECT_NEAR(glm::distance(beside->world, glm::dvec3(16.0)), 10.0, 0.05);
    EXPECT_NEAR(scene.level.at((beside->world + 0.5) / 33.0), 10.0, 1e-4) << "but it is a root";
    EXPECT_EQ(scene.hit({79, 50})->kind, HitKind::Middle) << "beside the ball";
}

TEST(PixelProbe, OnlyKeptAndVisibleSurfacesCount) {
    Scene scene = isosurfaces(alongZ, {25.0, 20.0});
    EXPECT_NEAR(scene.hit()->world.z, 25.0, kNoCrossing);
    scene.tile.isosurface.surfaces[0].colour.w = 0.0F;
    EXPECT_NEAR(scene.hit()->world.z, 20.0, kNoCrossing);
    EXPECT_EQ(scene.hit()->isovalue, 20.0);
    scene.tile.isosurface.surfaces[0].colour.w = 1.0F;
    scene.clipWith(ClipShape::Sphere, ClipMode::Clip, 3.0, {16.0, 16.0, 25.0});
    EXPECT_NEAR(scene.hit()->world.z, 20.0, kNoCrossing) << "the clip object has taken the first";
    scene.tile.clip.object->mode = ClipMode::Probe;
    EXPECT_NEAR(scene.hit()->world.z, 25.0, kNoCrossing);
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, -1.0}, -24.0}};
    EXPECT_EQ(scene.hit()->kind, HitKind::Middle) << "no surface in what is left";
}

TEST(PixelProbe, ACapLiesBeforeWhatItCloses) {
    Scene scene = isosurfaces(alongZ, {10.0});
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, -1.0}, -20.0}};
    EXPECT_NEAR(scene.hit()->world.z, 10.0, kNoCrossing);
    scene.tile.isosurface.caps = true;
    EXPECT_NEAR(scene.hit()->world.z, 20.0, 1e-9);
    EXPECT_EQ(scene.hit()->kind, HitKind::Face);
    scene.tile.clip.planes.clear();
    EXPECT_NEAR(scene.hit()->world.z, 10.0, kNoCrossing) << "the box's own faces are no cuts";
    scene.clipWith(ClipShape::Sphere, ClipMode::Clip, 4.0, {16.0, 16.0, 28.0});
    EXPECT_NEAR(scene.hit()->world.z, 24.0, 0.02) << "of the clip object";
    EXPECT_EQ(scene.hit()->kind, HitKind::Face);
}

TEST(PixelProbe, TheSurfaceTechniqueIsHitAtItsFirstKeptPoint) {
    Scene scene(constant);
    scene.tile.technique = Technique::Surface;
    EXPECT_NEAR(scene.hit()->world.z, 32.0, 1e-9) << "the box";
    EXPECT_EQ(scene.hit()->kind, HitKind::Face);
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, -1.0}, -20.0}};
    EXPECT_NEAR(scene.hit()->world.z, 20.0, 1e-9) << "the plane";
    scene.clipWith(ClipShape::Sphere, ClipMode::Probe, 8.0, {16.0, 16.0, 9.0});
    EXPECT_NEAR(scene.hit()->world.z, 17.0, 0.02) << "the clip object's outside";
    EXPECT_FALSE(scene.hit({80, 50})) << "beside it";
    scene.tile.clip.object->mode = ClipMode::Clip;
    scene.tile.clip.planes = {ClipPlane{{0.0, 0.0, -1.0}, -12.0}};
    EXPECT_NEAR(scene.hit()->world.z, 1.0, 0.02) << "the far side of the hole that it leaves";
}

TEST(PixelProbe, BinaryObjectsKeepWholeStretches) {
    Scene scene(constant);
    scene.tile.technique = Technique::Surface;
    scene.clipWith(ClipShape::Box, ClipMode::Probe, 8.0, glm::dvec3(16.0));
    scene.tile.clip.object->binary = true;
    // Samples of the shape are 0.25 apart here, and a ray steps by half a voxel.
    EXPECT_NEAR(scene.hit()->world.z, 24.0, 0.7);
}

TEST(PixelProbe, AnEyeInsideSeesTheWallOfTheHoleThatItStandsIn) {
    Scene scene(constant);
    scene.tile.technique = Technique::Surface;
    scene.tile.camera.projection = Projection::Perspective;
    scene.tile.camera.viewFromWorld[3] = glm::dvec4(-16.0, -16.0, -16.0, 1.0);
    EXPECT_NEAR(scene.hit()->world.z, 0.0, 1e-9) << "the box's far face";
    scene.clipWith(ClipShape::Sphere, ClipMode::Clip, 6.0, glm::dvec3(16.0));
    EXPECT_NEAR(scene.hit()->world.z, 10.0, 0.02);
}

TEST(PixelProbe, NoValueIsNoCrossingAndNotOpaque) {
    const auto holed = [](const glm::dvec3& p) { return p.z > 18 && p.z < 22 ? std::nan("") : p.z; };
    const Scene scene = isosurfaces(holed, {20.0, 5.0});
    EXPECT_NEAR(scene.hit()->world.z, 5.0, kNoCrossing);
    Scene volume(holed);
    volume.setOpacity(0.0F, 0.0F);
    EXPECT_EQ(volume.hit(kMiddle, 0.0)->kind, HitKind::Sample) << "any sample at all, but the absent ones";
}

TEST(PixelProbe, OrthographicRaysAreParallelAndTheTopRowIsUp) {
    CameraSpec camera;
    camera.projection = Projection::Orthographic;
    camera.heightWorld = 10;
    const Ray top = pixelRay(camera, {50, 0}, {100, 100});
    const Ray bottom = pixelRay(camera, {50, 100}, {100, 100});
    EXPECT_EQ(top.direction, bottom.direction);
    EXPECT_NEAR(top.origin.y, 5, 1e-12);
    EXPECT_NEAR(bottom.origin.y, -5, 1e-12);
}

} // namespace
} // namespace voxsheet::engine
