// Atoms, bonds and cells in pictures of volumes: where closed forms and the double-precision truth have them.
#include "base/errors.h"
#include "image/inside_scene.h"
#include "techniques/overlay/crystal_solids.h"
#include "volume/elements.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 72;
constexpr Technique kTechniques[] = {Technique::Slices,  Technique::Raycast,    Technique::Mip,
                                     Technique::Surface, Technique::Isosurface, Technique::Plane};

/// Goes on smoothly through the faces of the cell.
fields::AnalyticField waves() {
    fields::AnalyticField field;
    field.low = 0.0;
    field.high = 1.0;
    field.value = [](const glm::dvec3& cube) {
        const auto wave = [&](const glm::dvec3& periods, double phase) {
            return std::sin(std::numbers::pi * glm::dot(periods, cube) + phase);
        };
        return 0.4 + 0.2 * wave({1.0, 0.0, 1.0}, 0.6) + 0.15 * wave({0.0, 1.0, -1.0}, 2.2);
    };
    return field;
}

/// Colours as they are.
void lightEvenly(ShadingSpec& shading) {
    shading.ambient = 1.0;
    shading.diffuse = shading.specular = 0.0;
}

class CrystalPictures : public InsideScene {
protected:
    /// 5 x 6 x 5 Å, or sheared; samples about 0.3 Å apart.
    static Grid cell(bool sheared = true) {
        Grid grid;
        grid.dims = {16, 20, 16};
        grid.worldFromIndex[0] = {0.31, 0.0, sheared ? 0.03 : 0.0, 0.0};
        grid.worldFromIndex[1] = {sheared ? 0.08 : 0.0, 0.3, 0.0, 0.0};
        grid.worldFromIndex[2] = {0.0, sheared ? -0.05 : 0.0, 0.31, 0.0};
        grid.worldFromIndex[3] = {7.0, -3.0, 2.0, 1.0};
        grid.periodic = glm::bvec3(true);
        return grid;
    }
    static glm::dvec3 at(const Grid& grid, const glm::dvec3& fractions) {
        return glm::dvec3(grid.worldFromIndex * glm::dvec4(fractions * glm::dvec3(grid.dims), 1.0));
    }
    /// Four atoms, one of them in faces of the cell, and bonds between some.
    static Crystal crystalIn(const Grid& grid) {
        Crystal crystal;
        for (int axis = 0; axis < 3; ++axis)
            crystal.lattice[axis] = glm::dvec3(grid.worldFromIndex[axis]) * double(grid.dims[axis]);
        crystal.atoms = {{16, at(grid, {0.0, 0.3, 0.0})},
                         {8, at(grid, {0.25, 0.45, 0.2})},
                         {30, at(grid, {0.5, 0.5, 0.55})},
                         {8, at(grid, {0.7, 0.75, 0.5})}};
        return crystal;
    }
    void addCrystal(const std::string& key, const Grid& grid) {
        auto sampled = fields::sampleField(waves(), grid, ScalarType::F32, key);
        sampled.meta.crystal = crystalIn(grid);
        add(std::move(sampled));
    }
    static TileSpec tileOf(const std::string& key, const Grid& drawn, Technique technique,
                           Projection projection = Projection::Perspective) {
        auto tile = fields::tileOf(key, drawn, technique, kPixels);
        tile.camera =
            fields::cameraOf(drawn, technique == Technique::Plane ? Projection::Orthographic : projection);
        tile.transfer = fields::filledTable(0.0, 1.0);
        tile.unitLengthWorld = 0.2;
        tile.isosurface.surfaces = {{0.5, glm::vec4(0.9F, 0.6F, 0.3F, 1.0F)},
                                    {0.25, glm::vec4(0.2F, 0.5F, 0.9F, 0.4F)}};
        const auto cut = planeThrough(drawn, glm::dvec3(0.52), {0.2, 0.3, 1.0});
        tile.plane = {cut.normal, cut.offset, PlaneInterpolation::Linear};
        tile.shading.lightsView = {glm::normalize(glm::dvec3(0.5, 0.8, 0.4))};
        tile.crystal = {false, true, BondReach::Across, 0.5};
        return tile;
    }
};

TEST_F(CrystalPictures, AgreeWithTheTruthWithEveryTechnique) {
    for (const bool sheared : {false, true}) {
        const Grid grid = cell(sheared);
        const std::string key = sheared ? "sheared" : "straight";
        addCrystal(key, grid);
        for (const auto technique : kTechniques)
            for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
                auto tile = tileOf(key, grid, technique, projection);
                (void)agree(tile, 45.0, 900);
                tile.shading.enabled = technique != Technique::Mip && technique != Technique::Plane;
                tile.crystal.bonds = BondReach::InBox;
                tile.crystal.radiusScale = 0.8;
                (void)agree(tile, 45.0, 900);
            }
    }
}

/// Waves on a straight cell have many points just at an isovalue; the truth's side of it must be found there.
TEST_F(CrystalPictures, CrossingsAreTheTruthsThroughFiltersAsCoarseAsThoseOfGpus) {
    const Grid grid = cell(false);
    addCrystal("straight", grid);
    painter.techniques().setCoarseFiltering(true);
    painter.techniques().setRootInterpolation(true);
    for (const bool shading : {false, true})
        for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
            auto tile = tileOf("straight", grid, Technique::Isosurface, projection);
            tile.shading.enabled = shading;
            (void)agree(tile, shading ? 60.0 : 80.0, 900);
        }
}

TEST_F(CrystalPictures, AgreeWithTheTruthWhenShiftedRepeatedAndClipped) {
    const Grid grid = cell();
    addCrystal("crystal", grid);
    addBall("ball");
    const PeriodicWindow window{{0.4, -0.3, 0.7}, {2, 1, 1}};
    const auto drawn = drawnGrid(grid, window);
    for (const auto technique : kTechniques) {
        auto tile = tileOf("crystal", drawn, technique);
        tile.periodic = window;
        (void)agree(tile, 45.0, 600);
        tile.crystal.atoms = false; // sticks
        (void)agree(tile, 45.0, 600);
        tile.crystal.atoms = true;
        tile.clip.planes = {planeThrough(drawn, glm::dvec3(0.6, 0.5, 0.4), {-1.0, 0.2, -0.5})};
        (void)agree(tile, 45.0, 400);
        tile.clip.object =
            ClipObject{"ball", objectOver(fields::gridOf(fields::Geometry::Isotropic, 48), drawn, 0.4),
                       ClipMode::Clip, false};
        (void)agree(tile, 45.0, 300);
    }
}

TEST_F(CrystalPictures, AtomsStayWholeUntilACutIsAQuarterOfTheirRadiusAway) {
    const Grid grid = cell();
    addCrystal("crystal", grid);
    auto tile = tileOf("crystal", grid, Technique::Raycast);
    tile.crystal.bonds = BondReach::InBox;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-1.0, 0.3, -0.4));
    const double radius = 0.5 * elementOf(30).covalentRadius;
    const auto behindZinc = [&](double radii) {
        tile.clip.planes = {{normal, glm::dot(normal, at(grid, {0.5, 0.5, 0.55})) + radii * radius}};
        return agree(tile, 45.0, 400);
    };
    const auto shows = [](const fields::Picture& picture) {
        const auto zinc = elementOf(30).colour;
        return std::count_if(picture.pixels.begin(), picture.pixels.end(), [&](const glm::dvec4& pixel) {
            const auto rgb = glm::dvec3(pixel);
            return pixel.w == 1.0 && glm::dot(glm::normalize(rgb), glm::normalize(zinc)) > 0.995;
        });
    };
    lightEvenly(tile.shading);
    EXPECT_GT(shows(behindZinc(0.24)), 50);
    EXPECT_EQ(shows(behindZinc(0.26)), 0);
}

/// 1 in the middle of the box along z, 0 at its ends.
fields::AnalyticField slab() {
    fields::AnalyticField field;
    field.low = 0.0;
    field.high = 1.0;
    field.value = [](const glm::dvec3& cube) { return 1.0 - std::abs(cube.z); };
    return field;
}

/// Looks along z, from above or below, with parallel rays.
CameraSpec alongZ(const Grid& grid, bool fromAbove, double height) {
    CameraSpec camera;
    camera.projection = Projection::Orthographic;
    const auto centre = centreWorld(grid);
    const glm::dvec3 eye = centre + glm::dvec3(0.0, 0.0, fromAbove ? 20.0 : -20.0);
    camera.viewFromWorld = glm::lookAt(eye, centre, glm::dvec3(0.0, 1.0, 0.0));
    camera.heightWorld = height;
    return camera;
}

TransferFunction green(const std::vector<OpacityPoint>& opacities) {
    TransferFunction function;
    function.colours = {{0.0, {0.0, 1.0, 0.0}}, {1.0, {0.0, 1.0, 0.0}}};
    function.low = 0.0;
    function.high = 1.0;
    function.opacities = opacities;
    return function;
}

TEST_F(CrystalPictures, SpheresAreRoundAndLieAtTheirDepth) {
    Grid grid = cell(false);
    grid.periodic = glm::bvec3(false); // one atom is one sphere
    auto sampled = fields::sampleField(slab(), grid, ScalarType::F32, "fog");
    const glm::dvec3 centre = centreWorld(grid);
    Crystal crystal;
    crystal.atoms = {{8, centre}};
    sampled.meta.crystal = crystal;
    add(std::move(sampled));
    constexpr int pixels = 120;
    auto tile = fields::tileOf("fog", grid, Technique::Raycast, pixels);
    tile.camera = alongZ(grid, true, 5.0);
    tile.unitLengthWorld = 1.0;
    tile.crystal.atoms = true;
    tile.crystal.radiusScale = 2.0;
    lightEvenly(tile.shading);
    const double radius = 2.0 * elementOf(8).covalentRadius;
    const glm::dvec3 red = elementOf(8).colour;
    const auto overPixels = [&](const auto& visit) {
        constexpr double pixel = 5.0 / pixels;
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x) {
                const double across = std::hypot(x + 0.5 - pixels / 2, y + 0.5 - pixels / 2) * pixel;
                if (std::abs(across - radius) > 1e-3 * pixel) visit(x, y, across);
            }
    };

    tile.transfer = buildTransferTable(green({{0.0, 0.0}}));
    const auto alone = painter.draw(tile);
    overPixels([&](int x, int y, double across) {
        ASSERT_EQ(alone.at(x, y).w, across < radius ? 1.0 : 0.0) << x << ", " << y;
        if (across < radius) {
            ASSERT_LT(glm::distance(glm::dvec3(alone.at(x, y)), red), 1e-6);
        }
    });

    // In fog that lets 0.7 of the light pass per Å: as much as lies before the sphere.
    tile.transfer = buildTransferTable(green({{0.0, 0.3}}));
    const auto inFog = painter.draw(tile);
    const auto box = boxIndex(grid);
    const double front = glm::dvec3(grid.worldFromIndex * glm::dvec4(box.high, 1.0)).z;
    overPixels([&](int x, int y, double across) {
        if (across >= radius) return;
        const double depth = front - (centre.z + std::sqrt(radius * radius - across * across));
        const double left = std::pow(0.7, depth);
        ASSERT_NEAR(inFog.at(x, y).x, left * red.x, 1e-5) << x << ", " << y;
        ASSERT_NEAR(inFog.at(x, y).y, 1.0 - left + left * red.y, 1e-5) << x << ", " << y;
    });
}

TEST_F(CrystalPictures, AnOpaqueBlockHidesWhatLiesBehindItAndNotWhatStandsBefore) {
    Grid grid = cell(false);
    grid.periodic = glm::bvec3(false);
    const auto colourOf = [](int element) { return glm::dvec4(elementOf(element).colour, 1.0); };
    for (const auto& [key, depth] : {std::pair("in the box", 0.15), std::pair("out of it", -0.2)}) {
        auto sampled = fields::sampleField(slab(), grid, ScalarType::F32, key);
        const auto low = at(grid, {0.5, 0.3, depth});
        const auto high = at(grid, {0.5, 0.65, 1.0 - depth});
        Crystal crystal;
        crystal.atoms = {{7, low}, {9, high}};
        sampled.meta.crystal = crystal;
        add(std::move(sampled));
        for (const auto technique : kTechniques) {
            // A plane's picture knows nothing before and behind it, and faces hide all that is in the box.
            if (technique == Technique::Plane || (technique == Technique::Surface && depth > 0.0)) continue;
            auto tile = fields::tileOf(key, grid, technique, 64);
            tile.transfer = buildTransferTable(green({{0.0, 0.0}, {0.69, 0.0}, {0.7, 1.0}, {1.0, 1.0}}));
            tile.unitLengthWorld = 0.01;
            tile.isosurface.surfaces = {{0.7, glm::vec4(0.0F, 1.0F, 0.0F, 1.0F)}};
            tile.crystal.atoms = true;
            lightEvenly(tile.shading);
            for (const bool fromAbove : {true, false}) {
                tile.camera = alongZ(grid, fromAbove, 8.0);
                const auto picture = painter.draw(tile);
                const auto seen = [&](const glm::dvec3& world) {
                    const auto view = tile.camera.viewFromWorld * glm::dvec4(world, 1.0);
                    return picture.at(static_cast<int>(32.0 + view.x * 8.0),
                                      static_cast<int>(32.0 + view.y * 8.0));
                };
                const std::string what =
                    std::string(fields::nameOf(technique)) + " " + key + (fromAbove ? ", above" : ", below");
                EXPECT_LT(glm::distance(seen(fromAbove ? high : low), colourOf(fromAbove ? 9 : 7)), 0.01)
                    << what;
                EXPECT_LT(glm::distance(seen(fromAbove ? low : high), glm::dvec4(0.0, 1.0, 0.0, 1.0)), 0.01)
                    << what;
            }
        }
    }
}

TEST_F(CrystalPictures, EdgesOfCellsAreDrawnWhereTheyAreNotHidden) {
    const Grid grid = cell();
    addCrystal("crystal", grid);
    auto tile = tileOf("crystal", grid, Technique::Raycast);
    tile.crystal = {true, false, BondReach::None, 0.5};
    TransferFunction nothing;
    nothing.colours = {{0.0, {1.0, 1.0, 1.0}}, {1.0, {1.0, 1.0, 1.0}}};
    nothing.low = 0.0;
    nothing.high = 1.0;
    nothing.opacities = {{0.0, 0.0}, {1.0, 0.0}};
    tile.transfer = buildTransferTable(nothing);
    tile.sizePixels = glm::ivec2(160);
    const auto onEdges = [&](const fields::Picture& picture, const PeriodicWindow& window) {
        const double half = std::tan(glm::radians(tile.camera.fovYDegrees / 2.0));
        int seen = 0;
        int missed = 0;
        for (const auto& edge : cellEdges(crystalIn(grid), grid, window))
            for (int i = 1; i < 40; ++i) {
                const auto view =
                    tile.camera.viewFromWorld * glm::dvec4(glm::mix(edge.start, edge.end, i / 40.0), 1.0);
                const auto q = glm::dvec2(view) / -view.z / half;
                const auto pixel = glm::ivec2(glm::floor(80.0 + 80.0 * q));
                ++(picture.at(pixel.x, pixel.y).w > 0.0 ? seen : missed);
            }
        return std::pair(seen, missed);
    };
    auto picture = painter.draw(tile);
    EXPECT_EQ(onEdges(picture, {}), std::pair(12 * 39, 0)) << "no gaps";
    const auto lit = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                   [](const glm::dvec4& pixel) { return pixel.w > 0.0; });
    EXPECT_LT(lit, 160 * 160 / 8) << "they are thin";
    tile.periodic.replicate = {1, 2, 1};
    tile.camera = fields::cameraOf(drawnGrid(grid, tile.periodic), Projection::Perspective);
    EXPECT_EQ(onEdges(painter.draw(tile), tile.periodic), std::pair(20 * 39, 0));

    // Faces hide the edges behind them.
    tile.technique = Technique::Surface;
    tile.transfer = fields::filledTable(0.0, 1.0);
    picture = painter.draw(tile);
    tile.crystal = {};
    const auto without = painter.draw(tile);
    long changed = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        changed += picture.pixels[i] != without.pixels[i] ? 1 : 0;
    EXPECT_GT(changed, 200);
    EXPECT_LT(changed, lit * 5 / 6);
}

TEST_F(CrystalPictures, PartsOfAPictureAreThoseOfTheWhole) {
    const Grid grid = cell();
    addCrystal("crystal", grid);
    for (const auto technique : kTechniques) {
        auto tile = tileOf("crystal", grid, technique);
        tile.crystal.cell = true;
        const auto whole = painter.draw(tile);
        auto& context = painter.context();
        const gpu::Texture target(context, GL_TEXTURE_2D, GL_RGBA32F, glm::ivec3(tile.sizePixels, 1));
        const auto volumes = painter.techniques().acquire(painter.residency(), tile);
        for (const auto& rows : {PictureRows{0, 24}, PictureRows{24, 40}, PictureRows{40, kPixels}})
            painter.techniques().draw(tile, volumes, target, rows);
        std::vector<float> floats(static_cast<std::size_t>(kPixels) * kPixels * 4);
        glFinish();
        glGetTextureImage(target.id(), 0, GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(floats.size() * sizeof(float)), floats.data());
        const auto parts = fields::pictureFromFloats(tile.sizePixels, floats);
        EXPECT_EQ(parts.pixels, whole.pixels) << fields::nameOf(technique);
    }
}

TEST_F(CrystalPictures, DataWithoutACrystalAndKeysThatAreOffChangeNothing) {
    const Grid grid = cell();
    addCrystal("crystal", grid);
    add(waves(), grid, ScalarType::F32, "plain");
    for (const auto technique : kTechniques) {
        auto tile = tileOf("plain", grid, technique);
        tile.crystal.cell = true;
        const auto asked = painter.draw(tile);
        tile.crystal = {};
        const auto plain = painter.draw(tile);
        EXPECT_EQ(asked.pixels, plain.pixels);
        tile.dataset = "crystal";
        EXPECT_EQ(painter.draw(tile).pixels, plain.pixels);
    }
    auto tile = tileOf("crystal", grid, Technique::Raycast);
    tile.crystal.radiusScale = 0.0;
    EXPECT_THROW((void)painter.draw(tile), InvalidInput);
}

TEST_F(CrystalPictures, WithTheEyeInsideAnAtomThereIsItsInside) {
    const Grid grid = cell();
    addCrystal("crystal", grid);
    auto tile = tileOf("crystal", grid, Technique::Raycast);
    tile.crystal.cell = true;
    const auto eye = at(grid, {0.5, 0.5, 0.55});
    tile.camera.viewFromWorld = glm::lookAt(eye, eye + glm::dvec3(0.3, 1.0, 0.2), glm::dvec3(0.0, 0.0, 1.0));
    tile.camera.fovYDegrees = 90.0;
    for (const auto& pixel : painter.draw(tile).pixels)
        ASSERT_EQ(pixel.w, 1.0);
}

} // namespace
} // namespace voxsheet::image
