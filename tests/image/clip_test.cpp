// Clipping by planes, boxes and clip objects, for every technique, against the double-precision truth.
#include "image/inside_scene.h"

#include "base/errors.h"
#include "volume/convex_polytope.h"

#include <cmath>
#include <limits>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 80;
constexpr Technique kVolumes[] = {Technique::Raycast, Technique::Slices, Technique::Mip};

class Clip : public InsideScene {
protected:
    Clip() {
        addBall("ball");
        object.dataset = "ball";
    }
    TileSpec tileOn(const Grid& grid, const fields::AnalyticField& field, const std::string& key,
                    Projection projection = Projection::Perspective) {
        auto tile = fields::tileOf(key, grid, Technique::Raycast, kPixels);
        tile.transfer = fields::filledTable(field.low, field.high);
        tile.camera = fields::cameraOf(grid, projection);
        return tile;
    }
    ClipObject object;
    Grid objectGrid = fields::gridOf(fields::Geometry::Isotropic, 48);
};

TEST_F(Clip, PlanesAndBoxes) {
    const auto field = fields::gaussianSum();
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const auto grid = fields::gridOf(geometry, 36);
        const std::string key = fields::nameOf(geometry);
        add(field, grid, ScalarType::U16, key);
        for (const auto projection : {Projection::Perspective, Projection::Orthographic})
            for (const auto technique : kVolumes) {
                auto tile = tileOn(grid, field, key, projection);
                tile.technique = technique;
                const auto whole = painter.draw(tile);
                tile.clip.planes = {planeThrough(grid, glm::dvec3(0.5), {-1.0, 0.2, -0.6})};
                const auto half = agree(tile);
                EXPECT_LT(fields::difference(whole, half).psnr, 50.0) << "the plane is not seen";
                tile.clip.planes.clear();
                for (int axis = 0; axis < 3; ++axis) {
                    glm::dvec3 normal(0.1, -0.2, 0.15);
                    normal[axis] = 1.0;
                    tile.clip.planes.push_back(planeThrough(grid, glm::dvec3(0.2), normal));
                    tile.clip.planes.push_back(planeThrough(grid, glm::dvec3(0.7), -normal));
                }
                (void)agree(tile, 45.0, 200);
            }
    }
}

TEST_F(Clip, ObjectsKeepTheirInsideOrTheirOutside) {
    const auto field = fields::gaussianSum();
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const auto grid = fields::gridOf(geometry, 36);
        const std::string key = fields::nameOf(geometry);
        add(field, grid, ScalarType::U16, key);
        object.objectFromWorld = objectOver(objectGrid, grid, 0.7);
        for (const auto mode : {ClipMode::Probe, ClipMode::Clip})
            for (const bool binary : {false, true})
                for (const auto technique : kVolumes) {
                    auto tile = tileOn(grid, field, key);
                    tile.technique = technique;
                    object.mode = mode;
                    object.binary = binary;
                    tile.clip.object = object;
                    // A sample on the border of a voxel of the binary texture may fall to either side in
                    // 32-bit floats.
                    (void)agree(tile, binary ? 40.0 : 45.0);
                }
    }
}

TEST_F(Clip, PlanesAndObjectsTogetherWithLight) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Anisotropic, 36);
    add(field, grid, ScalarType::U16, "both");
    object.objectFromWorld = objectOver(objectGrid, grid, 0.8);
    object.mode = ClipMode::Probe;
    for (const auto technique : {Technique::Raycast, Technique::Slices}) {
        auto tile = tileOn(grid, field, "both");
        tile.technique = technique;
        tile.shading.enabled = true;
        tile.clip.object = object;
        tile.clip.planes = {planeThrough(grid, glm::dvec3(0.55), {-1.0, -0.3, -0.8})};
        // Whether a sample lies within a voxel behind a cut is decided in 32-bit floats: a few change sides.
        (void)agree(tile, 42.0);
    }
}

TEST_F(Clip, SurfacesOfCutsAndObjects) {
    const auto field = fields::marschnerLobb();
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const auto grid = fields::gridOf(geometry, 36);
        const std::string key = fields::nameOf(geometry);
        add(field, grid, ScalarType::F32, key);
        object.objectFromWorld = objectOver(objectGrid, grid, 0.7);
        for (const auto projection : {Projection::Perspective, Projection::Orthographic})
            for (const bool lit : {false, true}) {
                auto tile = tileOn(grid, field, key, projection);
                tile.technique = Technique::Surface;
                tile.shading.enabled = lit;
                // Pixels whose centre lies on an edge of a face may belong to either side.
                (void)agree(tile, 45.0, 1000);
                tile.clip.planes = {planeThrough(grid, glm::dvec3(0.5), {-1.0, 0.2, -0.6}),
                                    planeThrough(grid, glm::dvec3(0.6), {0.3, -1.0, 0.1})};
                (void)agree(tile, 40.0, 500);
                tile.clip.planes.pop_back();
                tile.clip.object = object;
                tile.clip.object->mode = ClipMode::Probe;
                (void)agree(tile, 40.0, 300);
                tile.clip.object->mode = ClipMode::Clip;
                (void)agree(tile, 40.0, 500);
            }
    }
}

TEST_F(Clip, TheEyeMayBeInsideWhatIsKept) {
    const auto field = fields::marschnerLobb();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 36);
    add(field, grid, ScalarType::F32, "inside");
    for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Mip, Technique::Surface}) {
        auto tile = tileOn(grid, field, "inside");
        tile.technique = technique;
        tile.camera.viewFromWorld = glm::inverse(glm::dmat4(1.0));
        tile.camera.viewFromWorld[3] = glm::dvec4(-centreWorld(grid) + glm::dvec3(1.3, 0.7, -5.1), 1.0);
        tile.camera.fovYDegrees = 80.0;
        tile.clip.planes = {planeThrough(grid, glm::dvec3(0.2), {0.2, 0.1, 1.0})};
        (void)agree(tile, 42.0, 3000);
    }
}

TEST_F(Clip, MovingAnObjectUploadsNothing) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 36);
    add(field, grid, ScalarType::U16, "moved");
    auto tile = tileOn(grid, field, "moved");
    tile.clip.object = object;
    tile.clip.object->mode = ClipMode::Probe; // all of its surface is seen
    tile.clip.object->objectFromWorld = objectOver(objectGrid, grid, 0.6);
    for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Mip, Technique::Surface}) {
        tile.technique = technique;
        auto before = painter.draw(tile);
        const auto uploaded = painter.residency().state().uploadedBytes;
        const auto textures = painter.context().counts().textureBytes;
        for (int step = 1; step <= 4; ++step) {
            tile.clip.object->objectFromWorld = objectOver(objectGrid, grid, 0.6 + 0.04 * step);
            tile.clip.object->objectFromWorld[3].x += 1.5 * step;
            const auto now = painter.draw(tile);
            EXPECT_LT(fields::difference(before, now).psnr, 60.0) << "it does not move";
            before = now;
        }
        EXPECT_EQ(painter.residency().state().uploadedBytes, uploaded);
        EXPECT_EQ(painter.context().counts().textureBytes, textures);
    }
}

TEST_F(Clip, WhatIsRemovedIsTransparentAndWhatMissesChangesNothing) {
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 24);
    add(field, grid, ScalarType::F32, "empty");
    for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Mip, Technique::Surface}) {
        auto tile = tileOn(grid, field, "empty");
        tile.technique = technique;
        const auto whole = painter.draw(tile);
        const auto isTransparent = [&] {
            const auto picture = painter.draw(tile);
            return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                               [](const glm::dvec4& pixel) { return pixel == glm::dvec4(0.0); });
        };
        tile.clip.planes = {planeThrough(grid, glm::dvec3(1.5), {1.0, 1.0, 1.0})};
        EXPECT_TRUE(isTransparent()) << "beyond the box";
        tile.clip.planes = {planeThrough(grid, glm::dvec3(0.4), {0.0, 0.0, 1.0}),
                            planeThrough(grid, glm::dvec3(0.3), {0.0, 0.0, -1.0})};
        EXPECT_TRUE(isTransparent()) << "between two planes that leave nothing";
        tile.clip.planes = {planeThrough(grid, glm::dvec3(-0.5), {1.0, 1.0, 1.0})};
        EXPECT_GT(fields::difference(whole, painter.draw(tile)).psnr, 100.0) << "a plane before the box";
        tile.clip.planes.clear();
        tile.clip.object = object;
        tile.clip.object->objectFromWorld[3] = glm::dvec4(1e4, 0.0, 0.0, 1.0);
        tile.clip.object->mode = ClipMode::Probe;
        EXPECT_TRUE(isTransparent()) << "inside an object far away";
        tile.clip.object->mode = ClipMode::Clip;
        EXPECT_GT(fields::difference(whole, painter.draw(tile)).psnr, 100.0) << "an object far away";
    }
}

TEST_F(Clip, RefusesWhatIsNoPlaneAndNoMatrix) {
    const auto field = fields::linearRamp();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 8);
    add(field, grid, ScalarType::U8, "refuse");
    const auto tile = tileOn(grid, field, "refuse");
    const auto refusedField = [&](const ClipSpec& clip) {
        auto spoiled = tile;
        spoiled.clip = clip;
        try {
            (void)painter.draw(spoiled);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("drawn");
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const auto& plane :
         {ClipPlane{glm::dvec3(0.0), 0.0}, ClipPlane{{nan, 0.0, 0.0}, 0.0}, ClipPlane{{1.0, 0.0, 0.0}, nan},
          ClipPlane{{1.0, 0.0, 0.0}, infinite}, ClipPlane{{2.0, 0.0, 0.0}, 0.0}})
        EXPECT_EQ(refusedField({{plane}, {}}), "clip.planes");
    EXPECT_EQ(refusedField({std::vector<ClipPlane>(kMaxClipPlanes + 1), {}}), "clip.planes");
    EXPECT_EQ(refusedField({std::vector<ClipPlane>(kMaxClipPlanes), {}}), "drawn");
    for (const auto& column :
         {glm::dvec4(0.0), glm::dvec4(nan, 0.0, 0.0, 0.0), glm::dvec4(1.0, 0.0, 0.0, 0.5)}) {
        ClipObject spoiled = object;
        spoiled.objectFromWorld[0] = column;
        EXPECT_EQ(refusedField({{}, spoiled}), "clip.transform");
    }
}

} // namespace
} // namespace voxsheet::image
