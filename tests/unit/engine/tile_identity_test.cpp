#include "engine/tile_identity.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace voxsheet::engine {
namespace {

TileSpec tile() {
    TileSpec spec;
    spec.dataset = "d";
    TransferTable table;
    table.entries = {glm::vec4(0.0F), glm::vec4(1.0F)};
    spec.transfer = std::make_shared<const TransferTable>(table);
    return spec;
}

using Change = std::function<void(TileSpec&)>;

std::set<std::string> identitiesOf(const TileSpec& base, const std::vector<Change>& changes) {
    std::set<std::string> identities;
    for (const Change& change : changes) {
        TileSpec spec = base;
        change(spec);
        identities.insert(tileIdentity(spec, RenderPath::Shader, "device"));
    }
    return identities;
}

void expectAllDiffer(const TileSpec& base, const std::vector<Change>& changes) {
    EXPECT_EQ(identitiesOf(base, changes).size(), changes.size());
}

void expectNoneDiffers(const TileSpec& base, const std::vector<Change>& changes) {
    EXPECT_EQ(identitiesOf(base, changes),
              std::set<std::string>{tileIdentity(base, RenderPath::Shader, "device")});
}

TEST(TileIdentity, EqualSpecsHaveEqualIdentitiesWhateverTheirTables) {
    const TileSpec a = tile();
    const TileSpec b = tile();
    ASSERT_NE(a.transfer, b.transfer);
    EXPECT_EQ(tileIdentity(a, RenderPath::Shader, "device"), tileIdentity(b, RenderPath::Shader, "device"));
    EXPECT_EQ(tileIdentity(a, RenderPath::Shader, "device").size(), 32U);
}

TEST(TileIdentity, EveryNumberThatDecidesPixelsCounts) {
    const auto changedTable = [](const std::function<void(TransferTable&)>& change) {
        return [change](TileSpec& spec) {
            TransferTable table = *spec.transfer;
            change(table);
            spec.transfer = std::make_shared<const TransferTable>(table);
        };
    };
    const std::vector<Change> changes{
        [](TileSpec&) {},
        [](TileSpec& s) { s.dataset = "e"; },
        [](TileSpec& s) { s.field = 1; },
        [](TileSpec& s) { s.step = 1; },
        [](TileSpec& s) { s.level = 1; },
        [](TileSpec& s) { s.technique = Technique::Mip; },
        [](TileSpec& s) { s.camera.viewFromWorld[3][2] = -1e-9; },
        [](TileSpec& s) { s.camera.fovYDegrees = 31; },
        [](TileSpec& s) { s.camera.projection = Projection::Orthographic; },
        [](TileSpec& s) { s.unitLengthWorld = 2; },
        [](TileSpec& s) { s.sampleDistanceVoxels = 0.25; },
        [](TileSpec& s) { s.classification = Classification::PreIntegrated; },
        [](TileSpec& s) { s.background.w = 0.5F; },
        [](TileSpec& s) { s.sizePixels.y = 255; },
        [](TileSpec& s) { s.floatTexels = FloatTexels::Half; },
        [](TileSpec& s) { s.periodic.shift.y = 0.5; },
        [](TileSpec& s) { s.periodic.replicate.y = 2; },
        [](TileSpec& s) { s.clip.planes = {ClipPlane{}}; },
        [](TileSpec& s) {
            s.clip.planes = {ClipPlane{{1.0, 0.0, 0.0}, 0.5}};
        },
        [](TileSpec& s) { s.clip.object = ClipObject{}; },
        [](TileSpec& s) {
            s.clip.object = ClipObject{"sphere", glm::dmat4(1.0), ClipMode::Clip, false};
        },
        [](TileSpec& s) {
            s.clip.object = ClipObject{"sphere", glm::dmat4(2.0), ClipMode::Clip, false};
        },
        [](TileSpec& s) {
            s.clip.object = ClipObject{"sphere", glm::dmat4(1.0), ClipMode::Probe, false};
        },
        [](TileSpec& s) {
            s.clip.object = ClipObject{"sphere", glm::dmat4(1.0), ClipMode::Clip, true};
        },
        changedTable([](TransferTable& t) { t.low = -1; }),
        changedTable([](TransferTable& t) { t.high = 2; }),
        changedTable([](TransferTable& t) { t.scale = ValueScale::Log; }),
        changedTable([](TransferTable& t) { t.symLogThreshold = 0.5; }),
        changedTable([](TransferTable& t) { t.below.x = 0.1F; }),
        changedTable([](TransferTable& t) { t.above.x = 0.1F; }),
        changedTable([](TransferTable& t) { t.entries[1].w = 0.9F; }),
        changedTable([](TransferTable& t) { t.entries.push_back(glm::vec4(1.0F)); }),
    };
    expectAllDiffer(tile(), changes);
    EXPECT_NE(tileIdentity(tile(), RenderPath::Shader, "device"),
              tileIdentity(tile(), RenderPath::Shader, "another device"));
    EXPECT_NE(tileIdentity(tile(), RenderPath::Shader, "device"),
              tileIdentity(tile(), RenderPath::Simd, "device"))
        << "paths may differ by 1/255";
}

TEST(TileIdentity, LightsCountWhereThereIsShading) {
    TileSpec shaded = tile();
    shaded.shading.enabled = true;
    shaded.shading.lightsView = {{0.0, 0.0, 1.0}};
    expectAllDiffer(shaded, {
                                [](TileSpec&) {},
                                [](TileSpec& s) { s.shading.enabled = false; },
                                [](TileSpec& s) { s.shading.gradient = GradientSource::Texture; },
                                [](TileSpec& s) { s.shading.ambient = 0.5; },
                                [](TileSpec& s) { s.shading.diffuse = 0.5; },
                                [](TileSpec& s) { s.shading.specular = 0.5; },
                                [](TileSpec& s) { s.shading.shininess = 5; },
                                [](TileSpec& s) { s.shading.headLight = 0.5; },
                                [](TileSpec& s) { s.shading.lightIntensity = 0.5; },
                                [](TileSpec& s) { s.shading.lightsView[0].x = 1; },
                                [](TileSpec& s) { s.shading.lightsView.clear(); },
                            });
    expectNoneDiffers(tile(), {
                                  [](TileSpec& s) { s.shading.ambient = 0.5; },
                                  [](TileSpec& s) {
                                      s.shading.lightsView = {{0.0, 0.0, 1.0}};
                                  },
                                  [](TileSpec& s) { s.shading.gradient = GradientSource::Texture; },
                              });
    TileSpec projection = shaded;
    projection.technique = Technique::Mip;
    expectNoneDiffers(projection, {[](TileSpec& s) { s.shading.enabled = false; }});
}

TEST(TileIdentity, CrystalsCountAndTheLightOnThem) {
    const std::vector<Change> lights{
        [](TileSpec&) {},
        [](TileSpec& s) { s.shading.ambient = 0.5; },
        [](TileSpec& s) {
            s.shading.lightsView = {{0.0, 0.0, 1.0}};
        },
    };
    TileSpec atoms = tile();
    atoms.crystal.atoms = true;
    expectAllDiffer(atoms, lights);
    expectAllDiffer(atoms, {
                               [](TileSpec&) {},
                               [](TileSpec& s) { s.crystal = {}; },
                               [](TileSpec& s) { s.crystal.cell = true; },
                               [](TileSpec& s) { s.crystal.bonds = BondReach::InBox; },
                               [](TileSpec& s) { s.crystal.bonds = BondReach::Across; },
                               [](TileSpec& s) { s.crystal.radiusScale = 1.0; },
                               [](TileSpec& s) { s.shading.enabled = true; },
                           });
    TileSpec cell = tile();
    cell.crystal.cell = true;
    expectNoneDiffers(cell, lights);
    expectNoneDiffers(cell, {[](TileSpec& s) { s.crystal.radiusScale = 1.0; }});
    atoms.technique = Technique::Plane;
    expectNoneDiffers(atoms, lights);
}

TEST(TileIdentity, APlaneIsItsPlaceAndColoursAndNothingElse) {
    const std::vector<Change> places{
        [](TileSpec&) {},
        [](TileSpec& s) {
            s.plane.normal = {1.0, 0.0, 0.0};
        },
        [](TileSpec& s) { s.plane.offset = 0.5; },
        [](TileSpec& s) { s.plane.interpolation = PlaneInterpolation::Nearest; },
    };
    TileSpec plane = tile();
    plane.technique = Technique::Plane;
    expectAllDiffer(plane, places);
    expectNoneDiffers(tile(), places);
    expectNoneDiffers(plane, {
                                 [](TileSpec& s) { s.clip.planes = {ClipPlane{}}; },
                                 [](TileSpec& s) { s.shading.enabled = true; },
                                 [](TileSpec& s) { s.sampleDistanceVoxels = 2.0; },
                                 [](TileSpec& s) { s.unitLengthWorld = 2.0; },
                             });
}

TEST(TileIdentity, IsosurfacesCountWhereTheyAreShown) {
    const auto colouredBy = [](float red, float opacity) {
        return [red, opacity](TileSpec& s) {
            TransferTable table = *s.transfer;
            table.entries[0] = {red, 0.0F, 0.0F, opacity};
            s.isosurface.colouredBy =
                ColourVolume{"other", 0, 0, 0, std::make_shared<const TransferTable>(table)};
        };
    };
    TileSpec surfaces = tile();
    surfaces.technique = Technique::Isosurface;
    surfaces.isosurface.surfaces = {Isosurface{0.5, glm::vec4(1.0F)}};
    expectAllDiffer(surfaces, {
                                  [](TileSpec&) {},
                                  [](TileSpec& s) { s.isosurface.surfaces.clear(); },
                                  [](TileSpec& s) { s.isosurface.surfaces[0].value = 1; },
                                  [](TileSpec& s) { s.isosurface.surfaces[0].colour.w = 0.5F; },
                                  [](TileSpec& s) { s.isosurface.surfaces.push_back({}); },
                                  [](TileSpec& s) { s.isosurface.caps = true; },
                                  [](TileSpec& s) { s.isosurface.method = IsosurfaceMethod::AlphaTest; },
                                  colouredBy(0.1F, 0.0F),
                                  colouredBy(0.2F, 0.0F),
                              });
    TileSpec a = surfaces;
    TileSpec b = surfaces;
    colouredBy(0.1F, 0.0F)(a);
    colouredBy(0.1F, 0.7F)(b);
    EXPECT_EQ(tileIdentity(a, RenderPath::Shader, "d"), tileIdentity(b, RenderPath::Shader, "d"))
        << "its opacities are not used";
    TileSpec rays = surfaces;
    rays.technique = Technique::Raycast;
    expectNoneDiffers(rays, {[](TileSpec& s) { s.isosurface = {}; }});
}

TEST(TileIdentity, LayersCount) {
    TileSpec fused = tile();
    fused.technique = Technique::Raycast;
    VolumeLayer layer;
    layer.dataset = "other";
    layer.transfer = fused.transfer;
    fused.layers.volumes = {layer};
    expectAllDiffer(fused, {
                               [](TileSpec&) {},
                               [](TileSpec& s) { s.layers.volumes.clear(); },
                               [](TileSpec& s) { s.layers.volumes.push_back(s.layers.volumes[0]); },
                               [](TileSpec& s) { s.layers.ownWeight = 0.5; },
                               [](TileSpec& s) { s.layers.volumes[0].dataset = "third"; },
                               [](TileSpec& s) { s.layers.volumes[0].field = 1; },
                               [](TileSpec& s) { s.layers.volumes[0].step = 1; },
                               [](TileSpec& s) { s.layers.volumes[0].level = 1; },
                               [](TileSpec& s) { s.layers.volumes[0].weight = 0.5; },
                               [](TileSpec& s) { s.layers.volumes[0].unitLengthWorld = 7; },
                               [](TileSpec& s) { s.layers.volumes[0].floatTexels = FloatTexels::Half; },
                               [](TileSpec& s) {
                                   TransferTable table = *s.layers.volumes[0].transfer;
                                   table.entries[1].w = 0.3F;
                                   s.layers.volumes[0].transfer =
                                       std::make_shared<const TransferTable>(table);
                               },
                           });
    TileSpec alone = tile();
    alone.technique = Technique::Raycast;
    expectNoneDiffers(alone, {[](TileSpec& s) { s.layers.ownWeight = 0.5; }});
}

TEST(TileIdentity, WhatTheTechniqueDoesNotUseDoesNotCount) {
    const Change opacity = [](TileSpec& s) {
        TransferTable table = *s.transfer;
        table.entries[1].w = 0.3F;
        s.transfer = std::make_shared<const TransferTable>(table);
    };
    const Change unit = [](TileSpec& s) { s.unitLengthWorld = 7; };
    TileSpec spec = tile();
    spec.technique = Technique::Surface;
    expectNoneDiffers(spec, {opacity, unit});
    spec.technique = Technique::Isosurface;
    expectNoneDiffers(spec, {opacity, unit});
    spec.technique = Technique::Mip;
    expectNoneDiffers(spec, {unit});
    expectAllDiffer(spec, {[](TileSpec&) {}, opacity});
}

TEST(TileIdentity, WhatTheProjectionDoesNotUseDoesNotCount) {
    TileSpec a = tile();
    TileSpec b = tile();
    b.camera.heightWorld = 5;
    EXPECT_EQ(tileIdentity(a, RenderPath::Shader, "d"), tileIdentity(b, RenderPath::Shader, "d"));
}

TEST(TileIdentity, TheBuildIsKnown) { EXPECT_EQ(buildIdentity().size(), 32U); }

} // namespace
} // namespace voxsheet::engine
