// Shift and replicate of periodic volumes: the same pictures as of data that were shifted or written out, and
// those of the double-precision truth.
#include "base/errors.h"
#include "image/inside_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 80;
constexpr double kPicturesStep = 1.0 / 255.0;
constexpr Technique kTechniques[] = {Technique::Slices,  Technique::Raycast,    Technique::Mip,
                                     Technique::Surface, Technique::Isosurface, Technique::Plane};

/// Three plane waves of whole periods over each cell, as they lie in `replicate` cells when the phase of each
/// is moved by `shift` (fractions of one cell).
fields::AnalyticField waves(const glm::dvec3& shift = glm::dvec3(0.0),
                            const glm::dvec3& replicate = glm::dvec3(1.0)) {
    fields::AnalyticField field;
    field.low = 0.0;
    field.high = 1.0;
    field.value = [shift, replicate](const glm::dvec3& cube) {
        const auto t = 0.5 * (cube + 1.0) * replicate - shift;
        const auto wave = [&](const glm::dvec3& periods, double phase) {
            return std::sin(2.0 * std::numbers::pi * (glm::dot(periods, t) + phase));
        };
        return 0.5 + 0.2 * wave({1.0, 0.0, 1.0}, 0.1) + 0.17 * wave({0.0, 2.0, -1.0}, 0.35) +
               0.1 * wave({2.0, -1.0, 0.0}, 0.6);
    };
    return field;
}

class Periodic : public InsideScene {
protected:
    /// Cells of empty space that the size does not fill: 22 = 5 * 4 + 2, 21 = 5 * 4 + 1.
    static Grid cell(fields::Geometry geometry, bool slab = false) {
        auto grid = fields::gridOf(geometry, 20);
        grid.dims = {22, 20, 21};
        grid.periodic = glm::bvec3(true, true, !slab);
        return grid;
    }

    /// Lit, and with half a clip; the picture of `key`, whose drawn box is that of `drawn`.
    static TileSpec tileOf(const std::string& key, const Grid& drawn, Technique technique) {
        auto tile = fields::tileOf(key, drawn, technique, kPixels);
        tile.transfer = fields::sparseTable(0.0, 1.0);
        tile.shading.enabled = technique != Technique::Mip;
        tile.shading.lightsView = {glm::normalize(glm::dvec3(0.5, 0.8, 0.4))};
        tile.isosurface.surfaces = {{0.72, glm::vec4(0.9F, 0.6F, 0.3F, 1.0F)},
                                    {0.3, glm::vec4(0.2F, 0.5F, 0.9F, 0.4F)}};
        tile.isosurface.caps = true;
        const auto cut = planeThrough(drawn, glm::dvec3(0.6, 0.5, 0.4), {-1.0, 0.2, -0.5});
        tile.clip.planes = {cut};
        tile.plane = {cut.normal, cut.offset, PlaneInterpolation::Linear};
        if (technique == Technique::Plane) tile.camera = fields::cameraOf(drawn, Projection::Orthographic);
        return tile;
    }

    /// Not the same bits: texture coordinates are 32-bit floats, and those of other periods round otherwise.
    static void expectSamePicture(const fields::Picture& a, const fields::Picture& b,
                                  const std::string& what) {
        const auto same = fields::difference(a, b);
        std::printf("%-34s %6.1f dB (alpha %6.1f, p99.9 %.1e, largest %.1e) %zu pixels\n", what.c_str(),
                    same.psnr, same.psnrAlpha, same.p999, same.largest, same.pixels);
        EXPECT_LE(same.largest, kPicturesStep) << what;
        EXPECT_GE(same.psnr, 80.0) << what;
        EXPECT_GE(same.psnrAlpha, 80.0) << what;
        EXPECT_GE(same.pixels, 500U) << what;
    }

    void sameWithoutSkipping(const TileSpec& tile, const std::string& what) {
        const auto skipped = painter.draw(tile);
        painter.techniques().setEmptySpaceSkipping(false);
        const auto whole = painter.draw(tile);
        painter.techniques().setEmptySpaceSkipping(true);
        const auto same = fields::difference(skipped, whole);
        EXPECT_GT(std::min(same.psnr, same.psnrAlpha), 90.0) << what;
    }

    /// The field of the key: refused tile's error.
    std::string refusedField(const TileSpec& tile) {
        try {
            (void)painter.draw(tile);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return "";
    }
};

TEST_F(Periodic, AShiftByWholeVoxelsIsThePictureOfTheShiftedField) {
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const auto grid = cell(geometry);
        const std::string name = fields::nameOf(geometry);
        const auto shift = glm::dvec3(9.0, -6.0, 13.0) / glm::dvec3(grid.dims);
        add(waves(), grid, ScalarType::F32, name);
        add(waves(shift), grid, ScalarType::F32, name + " moved");
        for (const auto technique : kTechniques) {
            auto tile = tileOf(name, grid, technique);
            const auto unmoved = painter.draw(tile);
            tile.periodic.shift = shift;
            const auto moved = painter.draw(tile);
            EXPECT_LT(fields::difference(unmoved, moved).psnr, 40.0) << "the shift shows";
            expectSamePicture(moved, painter.draw(tileOf(name + " moved", grid, technique)),
                              name + " " + fields::nameOf(technique));
        }
    }
}

TEST_F(Periodic, PeriodsAreThePictureOfTheDataWrittenOut) {
    for (const bool slab : {false, true}) {
        const auto grid = cell(fields::Geometry::Sheared, slab);
        const std::string name = slab ? "slab" : "crystal";
        add(waves(), grid, ScalarType::F32, name);
        for (const auto& replicate : {glm::ivec3(2, 1, 1), glm::ivec3(2, 3, slab ? 1 : 2)}) {
            auto written = grid;
            written.dims *= replicate;
            const auto key = name + " " + std::to_string(replicate.y);
            add(waves(glm::dvec3(0.0), replicate), written, ScalarType::F32, key);
            for (const auto technique : kTechniques) {
                auto tile = tileOf(name, written, technique);
                tile.periodic.replicate = replicate;
                expectSamePicture(painter.draw(tile), painter.draw(tileOf(key, written, technique)),
                                  key + " " + fields::nameOf(technique));
            }
        }
    }
}

TEST_F(Periodic, BothAgreeWithTheTruthAtAnyShift) {
    const auto grid = cell(fields::Geometry::Sheared);
    add(waves(), grid, ScalarType::F32, "crystal");
    addBall("ball");
    const PeriodicWindow window{{0.313, -0.27, 0.8}, {2, 1, 2}};
    const auto drawn = drawnGrid(grid, window);
    for (const auto technique : kTechniques)
        for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
            if (technique == Technique::Plane && projection == Projection::Perspective) continue;
            auto tile = tileOf("crystal", drawn, technique);
            tile.camera = fields::cameraOf(drawn, projection);
            tile.periodic = window;
            tile.shading.gradient =
                technique == Technique::Raycast ? GradientSource::Texture : GradientSource::OnTheFly;
            if (technique != Technique::Isosurface)
                tile.clip.object = ClipObject{
                    "ball", objectOver(fields::gridOf(fields::Geometry::Isotropic, 48), drawn, 0.4),
                    ClipMode::Clip, false};
            tile.sizePixels = glm::ivec2(56); // the truth is slow
            (void)agree(tile);
            tile.plane.interpolation = PlaneInterpolation::Nearest;
            if (technique == Technique::Plane) (void)agree(tile);
        }
}

TEST_F(Periodic, EmptySpaceIsSkippedAcrossPeriods) {
    const auto grid = cell(fields::Geometry::Isotropic);
    // A small ball of material in a cell that is empty otherwise: long leaps, many of them over a seam.
    auto blob = waves();
    blob.value = [](const glm::dvec3& p) {
        return std::max(0.0, 1.0 - glm::length(p - glm::dvec3(-0.55)) / 0.4);
    };
    add(blob, grid, ScalarType::F32, "blob");
    for (const auto& replicate : {glm::ivec3(3, 2, 2)})
        for (const auto& shift : {glm::dvec3(0.0), glm::dvec3(0.4, 0.7, 0.15)})
            for (const auto technique : kTechniques)
                for (const auto azimuth : {30.0, 210.0}) {
                    if (technique == Technique::Plane) continue; // Nothing is skipped there.
                    const PeriodicWindow window{shift, replicate};
                    const auto drawn = drawnGrid(grid, window);
                    auto tile = tileOf("blob", drawn, technique);
                    tile.camera = fields::cameraOf(drawn, Projection::Perspective, azimuth, azimuth / 8.0);
                    tile.clip.planes.clear();
                    tile.isosurface.surfaces = {{0.6, glm::vec4(1.0F)}};
                    tile.periodic = window;
                    tile.sampleDistanceVoxels = 0.2;
                    sameWithoutSkipping(tile, std::string(fields::nameOf(technique)) + " " +
                                                  std::to_string(replicate.x) + " " +
                                                  std::to_string(shift.x));
                }
}

TEST_F(Periodic, NothingMoreIsUploaded) {
    const auto grid = cell(fields::Geometry::Isotropic);
    add(waves(), grid, ScalarType::F32, "crystal");
    auto tile = tileOf("crystal", grid, Technique::Raycast);
    tile.shading.gradient = GradientSource::Texture;
    (void)painter.draw(tile);
    const auto before = painter.residency().state();
    tile.periodic = {{0.5, 0.5, 0.5}, {2, 2, 2}};
    (void)painter.draw(tile);
    const auto after = painter.residency().state();
    EXPECT_EQ(after.residentBytes, before.residentBytes);
    EXPECT_EQ(after.uploads, before.uploads);
}

TEST_F(Periodic, OtherVolumesStayWhereTheyAre) {
    const auto grid = cell(fields::Geometry::Sheared);
    add(waves(), grid, ScalarType::F32, "crystal");
    add(fields::gaussianSum(), fields::gridOf(fields::Geometry::Sheared, 20), ScalarType::F32, "other");
    auto tile = tileOf("crystal", grid, Technique::Raycast);
    VolumeLayer layer;
    layer.dataset = "other";
    layer.transfer = fields::filledTable(0.0, 1.2);
    tile.layers.volumes = {layer};
    tile.layers.ownWeight = 0.0;
    const auto before = painter.draw(tile);
    tile.periodic.shift = {0.5, 0.25, 0.7};
    expectSamePicture(before, painter.draw(tile), "layer");
    tile.layers.ownWeight = 0.7;
    (void)agree(tile);

    auto iso = tileOf("crystal", grid, Technique::Isosurface);
    iso.periodic = tile.periodic;
    iso.isosurface.colouredBy = ColourVolume{"other", 0, 0, 0, layer.transfer};
    (void)agree(iso, 30.0);
}

TEST_F(Periodic, AxesThatDoNotWrapAreRefused) {
    const auto grid = cell(fields::Geometry::Isotropic, true);
    add(waves(), grid, ScalarType::F32, "slab");
    auto tile = tileOf("slab", grid, Technique::Raycast);
    tile.periodic.shift.z = 0.5;
    EXPECT_EQ(refusedField(tile), "periodic.shift");
    tile.periodic = {glm::dvec3(0.0), {1, 1, 2}};
    EXPECT_EQ(refusedField(tile), "periodic.replicate");
    tile.periodic = {{0.5, 0.5, 0.0}, {2, 2, 1}};
    EXPECT_EQ(refusedField(tile), "");
}

} // namespace
} // namespace voxsheet::image
