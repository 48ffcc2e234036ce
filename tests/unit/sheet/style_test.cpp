#include "sheet/style.h"

#include "sheet_fixture.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace voxsheet::sheet {
namespace {

double fovAt(const Sheet& sheet, const Address& address, const StyleOverlay& overlay = {}) {
    return resolveStyle(testKeys(), sheet, address, overlay).style.camera.fovDegrees;
}

Layer originAt(const Sheet& sheet, const Address& address) {
    return resolveStyle(testKeys(), sheet, address).values.at("camera.fov").origin;
}

TEST(Style, DefaultsComeFromTheTable) {
    const Workbook workbook = filledWorkbook(2, 2);
    const ResolvedStyle resolved = resolveStyle(testKeys(), workbook.sheets[0], {0, 0});
    EXPECT_EQ(resolved.values.size(), testKeys().keys().size());
    for (const auto& [key, value] : resolved.values) {
        EXPECT_EQ(value.value, testKeys().at(key).defaultValue) << key;
        EXPECT_EQ(value.origin.kind, LayerKind::Default) << key;
    }
    EXPECT_NO_THROW(requireConsistent(resolved.style));
}

TEST(Style, NearerLayersWinKeyByKey) {
    Workbook workbook = filledWorkbook(3, 2);
    Sheet& sheet = workbook.sheets[0];
    sheet.style["camera.fov"] = 31.0;
    EXPECT_EQ(fovAt(sheet, {1, 1}), 31.0);
    EXPECT_EQ(originAt(sheet, {1, 1}), Layer::sheet());
    sheet.columnHeaders[1].style["camera.fov"] = 32.0;
    EXPECT_EQ(fovAt(sheet, {1, 1}), 32.0);
    EXPECT_EQ(originAt(sheet, {1, 1}), Layer::ofColumn(1));
    EXPECT_EQ(fovAt(sheet, {0, 1}), 31.0) << "another column";
    sheet.rowHeaders[1].style["camera.fov"] = 33.0;
    EXPECT_EQ(fovAt(sheet, {1, 1}), 33.0) << "a row is nearer than a column";
    EXPECT_EQ(fovAt(sheet, {1, 0}), 32.0);
    sheet.cells[{1, 1}].style["camera.fov"] = 34.0;
    EXPECT_EQ(fovAt(sheet, {1, 1}), 34.0);
    EXPECT_EQ(originAt(sheet, {1, 1}), Layer::ofCell({1, 1}));
    EXPECT_EQ(resolveStyle(testKeys(), sheet, {1, 1}).style.camera.azimuthDegrees, 150.0)
        << "other keys stay inherited";
}

TEST(Style, PagesAndRequestsLieInBetweenAndAbove) {
    Workbook workbook = filledWorkbook(2, 1);
    Sheet& sheet = workbook.sheets[0];
    sheet.style["camera.fov"] = 31.0;
    StyleOverlay overlay;
    overlay.view["camera.fov"] = 50.0;
    EXPECT_EQ(fovAt(sheet, {0, 0}, overlay), 50.0);
    sheet.cells[{0, 0}].style["camera.fov"] = 34.0;
    EXPECT_EQ(fovAt(sheet, {0, 0}, overlay), 34.0) << "a cell with a view of its own is not linked";
    EXPECT_EQ(fovAt(sheet, {1, 0}, overlay), 50.0);
    overlay.cells[{0, 0}]["camera.fov"] = 51.0;
    EXPECT_EQ(fovAt(sheet, {0, 0}, overlay), 51.0);
    overlay.request["camera.fov"] = 60.0;
    EXPECT_EQ(fovAt(sheet, {0, 0}, overlay), 60.0);
    overlay.request["no.key"] = 1.0;
    EXPECT_THROW((void)fovAt(sheet, {0, 0}, overlay), InvalidInput);
}

TEST(Style, NoneIsAValueThatHidesAFartherOne) {
    Workbook workbook = filledWorkbook(1, 1);
    Sheet& sheet = workbook.sheets[0];
    sheet.style["transfer.belowColor"] = Colour{{255, 0, 0, 255}};
    EXPECT_TRUE(resolveStyle(testKeys(), sheet, {0, 0}).style.transfer.below.has_value());
    sheet.cells[{0, 0}].style["transfer.belowColor"] = None{};
    EXPECT_FALSE(resolveStyle(testKeys(), sheet, {0, 0}).style.transfer.below.has_value());
}

TEST(Style, OutsideTheSheetIsNotFound) {
    const Workbook workbook = filledWorkbook(2, 2);
    EXPECT_THROW((void)resolveStyle(testKeys(), workbook.sheets[0], {2, 0}), NotFound);
    EXPECT_THROW((void)resolveStyle(testKeys(), workbook.sheets[0], {0, -1}), NotFound);
    EXPECT_THROW((void)ownStyle(workbook.sheets[0], Layer::ofColumn(2)), NotFound);
    EXPECT_THROW((void)ownStyle(workbook.sheets[0], {LayerKind::Request, 0, 0}), InvalidInput);
}

TEST(Style, LayersResolveWithWhatReachesThem) {
    Workbook workbook = filledWorkbook(2, 2);
    Sheet& sheet = workbook.sheets[0];
    sheet.style["camera.fov"] = 31.0;
    sheet.columnHeaders[0].style["camera.roll"] = 5.0;
    const auto column = resolveLayer(testKeys(), sheet, Layer::ofColumn(0));
    EXPECT_EQ(column.at("camera.fov").origin, Layer::sheet());
    EXPECT_EQ(column.at("camera.roll").origin, Layer::ofColumn(0));
    EXPECT_EQ(resolveLayer(testKeys(), sheet, Layer::ofRow(0)).at("camera.roll").origin.kind,
              LayerKind::Default);
    const auto json = resolvedToJson(column, Layer::ofColumn(0));
    EXPECT_EQ(json["camera.roll"]["value"], 5.0);
    EXPECT_EQ(json["camera.roll"]["origin"], "column A");
    EXPECT_EQ(json["camera.roll"]["own"], true);
    EXPECT_EQ(json["camera.fov"]["own"], false);
}

TEST(Style, EveryChoiceHasAMeaning) {
    Workbook workbook = filledWorkbook(1, 1);
    Sheet& sheet = workbook.sheets[0];
    for (const KeySpec& key : testKeys().keys()) {
        if (key.type != KeyType::Choice) continue;
        std::vector<TypedStyle> seen;
        for (const std::string& word : key.choices) {
            sheet.style = {{key.name, word}};
            const TypedStyle style = resolveStyle(testKeys(), sheet, {0, 0}).style;
            EXPECT_EQ(std::count(seen.begin(), seen.end(), style), 0) << key.name << "=" << word;
            seen.push_back(style);
        }
    }
}

TEST(Style, ChoicesMapToTheirEnums) {
    Workbook workbook = filledWorkbook(1, 1);
    Sheet& sheet = workbook.sheets[0];
    sheet.style = {{"technique", std::string("mip")},
                   {"camera.projection", std::string("orthographic")},
                   {"range.mode", std::string("percentile")},
                   {"range.scale", std::string("symlog")},
                   {"transfer.shape", std::string("parabolic")},
                   {"quality", std::string("quarter")},
                   {"annotations", std::string("names")},
                   {"field", std::string("rho")},
                   {"time", std::int64_t{7}}};
    const TypedStyle style = resolveStyle(testKeys(), sheet, {0, 0}).style;
    EXPECT_EQ(style.technique, Technique::Mip);
    EXPECT_EQ(style.camera.projection, Projection::Orthographic);
    EXPECT_EQ(style.range.mode, RangeMode::Percentile);
    EXPECT_EQ(style.range.scale, ValueScale::SymLog);
    EXPECT_EQ(style.transfer.shape, TransferShape::Parabolic);
    EXPECT_EQ(style.quality, Quality::Quarter);
    EXPECT_EQ(style.annotations, Annotations::Names);
    EXPECT_EQ(style.field, FieldChoice(std::string("rho")));
    EXPECT_EQ(style.timeStep, 7);
}

TEST(Style, NearerValuesThatHideAnEditAreNamed) {
    Workbook workbook = filledWorkbook(2, 2);
    Sheet& sheet = workbook.sheets[0];
    EXPECT_TRUE(hiddenBy(sheet, Layer::sheet(), {"camera.fov"}).empty());
    sheet.columnHeaders[1].style["camera.fov"] = 32.0;
    sheet.rowHeaders[0].style["camera.fov"] = 33.0;
    sheet.cells[{0, 1}].style["camera.fov"] = 34.0;
    const auto hidden = hiddenBy(sheet, Layer::sheet(), {"camera.fov", "camera.roll"});
    ASSERT_EQ(hidden.size(), 3U);
    EXPECT_EQ(hidden[0].nearer, Layer::ofRow(0));
    EXPECT_EQ(hidden[0].cells.size(), 2U);
    EXPECT_EQ(hidden[1].nearer, Layer::ofCell({0, 1}));
    EXPECT_EQ(hidden[2].nearer, Layer::ofColumn(1));
    EXPECT_EQ(hidden[2].cells, std::vector<Address>({{1, 1}}));
    EXPECT_EQ(hiddenSentence(hidden), "camera.fov is set nearer by row 1, cell A2, column B");
    EXPECT_EQ(hiddenBy(sheet, Layer::ofColumn(0), {"camera.fov"}).size(), 2U);
    EXPECT_EQ(hiddenBy(sheet, Layer::ofRow(1), {"camera.fov"}).size(), 1U);
    EXPECT_TRUE(hiddenBy(sheet, Layer::ofCell({1, 0}), {"camera.fov"}).empty());
}

TEST(Style, OverridesAreListed) {
    Workbook workbook = filledWorkbook(2, 2);
    Sheet& sheet = workbook.sheets[0];
    sheet.style["camera.fov"] = 31.0;
    sheet.columnHeaders[1].style["camera.fov"] = 32.0;
    sheet.cells[{0, 1}].style["technique"] = std::string("mip");
    const auto overrides = listOverrides(sheet);
    ASSERT_EQ(overrides.size(), 2U) << "what the sheet sets is no override";
    EXPECT_EQ(layerName(overrides[0].layer), "column B");
    EXPECT_EQ(overrides[1].key, "technique");
}

TEST(Style, KeysThatDisagreeAreRefused) {
    TypedStyle style = resolveStyle(testKeys(), filledWorkbook(1, 1).sheets[0], {0, 0}).style;
    style.transfer.cut1 = style.transfer.cut2;
    EXPECT_EQ(caught<InvalidInput>([&] { requireConsistent(style); }).field(), "transfer.cut1");
    style.transfer.cut1 = 0.1;
    style.range = {RangeMode::Fixed, 2.0, 1.0, ValueScale::Linear};
    EXPECT_EQ(caught<InvalidInput>([&] { requireConsistent(style); }).field(), "range.min");
    style.range.mode = RangeMode::Own;
    EXPECT_NO_THROW(requireConsistent(style)) << "the bounds are not in use";
    style.range = {RangeMode::Percentile, -1.0, 99.0, ValueScale::Linear};
    EXPECT_EQ(caught<InvalidInput>([&] { requireConsistent(style); }).field(), "range.min");
    style.range = {RangeMode::Percentile, 99.9, std::nullopt, ValueScale::Linear};
    EXPECT_THROW(requireConsistent(style), InvalidInput) << "the other end is 99.5";
    style.range = {RangeMode::Fixed, 99.9, std::nullopt, ValueScale::Linear};
    EXPECT_NO_THROW(requireConsistent(style)) << "the other end is the data's";
}

TEST(Style, LooksInsideAreTyped) {
    Workbook workbook = filledWorkbook(1, 1);
    Sheet& sheet = workbook.sheets[0];
    sheet.style =
        parseStyleMap(testKeys(), nlohmann::json{{"technique", "isosurface"},
                                                 {"isovalue", {0.5, -0.5}},
                                                 {"isosurface.mirror", "on"},
                                                 {"isosurface.colors", {"#ff0000"}},
                                                 {"isosurface.opacity", {1, 0.25}},
                                                 {"isosurface.colorBy", "B1"},
                                                 {"layers", "B1; run 2"},
                                                 {"layers.weights", {0.5, 1}},
                                                 {"clip.planes", {{1, 0, 0, 0.5}, {0, 2, 0, 0.1}}},
                                                 {"clip.box", {0, 1, 0.25, 0.75, 0.5, 1}},
                                                 {"clip.units", "world"},
                                                 {"clip.shape", "torus"},
                                                 {"clip.mode", "probe"},
                                                 {"clip.transform", {1, 2, 3, 10, 20, 30, 0.5, 0.6, 0.7}},
                                                 {"shading.model", "phong"},
                                                 {"shading.gradient", "onthefly"},
                                                 {"light.direction", {{0, 1, 1}}},
                                                 {"light.frame", "world"},
                                                 {"texture.format", "half"},
                                                 {"probe.opacity", 0.3}});
    const TypedStyle style = resolveStyle(testKeys(), sheet, {0, 0}).style;
    EXPECT_EQ(style.technique, Technique::Isosurface);
    EXPECT_EQ(style.isosurface.values, (std::vector<double>{0.5, -0.5}));
    EXPECT_TRUE(style.isosurface.mirror);
    EXPECT_EQ(style.isosurface.colours.size(), 1U);
    EXPECT_EQ(style.isosurface.opacities, (std::vector<double>{1.0, 0.25}));
    EXPECT_EQ(style.isosurface.colourBy, "B1");
    EXPECT_EQ(style.layers, (LayersStyle{"B1; run 2", {0.5, 1.0}}));
    ASSERT_EQ(style.clip.planes.size(), 2U);
    EXPECT_EQ(style.clip.planes[1], (ClipStyle::Plane{{0, 2, 0}, 0.1}));
    ASSERT_TRUE(style.clip.box.has_value());
    EXPECT_EQ(style.clip.box->low, glm::dvec3(0, 0.25, 0.5));
    EXPECT_EQ(style.clip.box->high, glm::dvec3(1, 0.75, 1));
    EXPECT_EQ(style.clip.units, ClipUnits::World);
    EXPECT_EQ(style.clip.shape, "torus");
    EXPECT_EQ(style.clip.mode, ClipMode::Probe);
    EXPECT_EQ(style.clip.transform.rotationDegrees, glm::dvec3(10, 20, 30));
    EXPECT_EQ(style.clip.transform.scale, glm::dvec3(0.5, 0.6, 0.7));
    EXPECT_EQ(style.shading.model, ShadingModel::Phong);
    EXPECT_EQ(style.shading.gradient, GradientSource::OnTheFly);
    EXPECT_EQ(style.light.directions, (std::vector<glm::dvec3>{{0, 1, 1}}));
    EXPECT_EQ(style.light.frame, LightFrame::World);
    EXPECT_EQ(style.textureFormat, TextureFormat::Half);
    EXPECT_EQ(style.probeOpacity, std::optional<double>(0.3));

    const TypedStyle initial = resolveStyle(testKeys(), Workbook{}.sheets[0], {0, 0}).style;
    EXPECT_TRUE(initial.isosurface.values.empty()) << "auto";
    EXPECT_EQ(initial.shading.model, ShadingModel::Auto);
    EXPECT_EQ(initial.clip, ClipStyle{});
}

std::string refusedField(const TypedStyle& style) {
    return caught<InvalidInput>([&] { requireConsistent(style); }).field();
}

TEST(Style, PlaneKeysReachTheTypedStyle) {
    Workbook workbook = filledWorkbook(1, 1);
    Sheet& sheet = workbook.sheets[0];
    EXPECT_EQ(resolveStyle(testKeys(), sheet, {0, 0}).style.plane, PlaneStyle{}) << "the documented defaults";
    sheet.style = parseStyleMap(testKeys(), nlohmann::json{{"technique", "plane"},
                                                           {"plane.axis", "custom"},
                                                           {"plane.normal", {1, 0, -2}},
                                                           {"plane.position", 0.25},
                                                           {"plane.interpolation", "nearest"}});
    const TypedStyle style = resolveStyle(testKeys(), sheet, {0, 0}).style;
    EXPECT_EQ(style.technique, Technique::Plane);
    EXPECT_EQ(style.plane, (PlaneStyle{PlaneAxis::Custom,
                                       {1, 0, -2},
                                       0.25,
                                       PlaneInterpolation::Nearest,
                                       std::nullopt,
                                       PlaneUnits::Fraction,
                                       {1, 1, 1}}));
    sheet.style = parseStyleMap(testKeys(), nlohmann::json{{"plane.crosshair", {3, 4.5, -6}},
                                                           {"plane.units", "world"},
                                                           {"camera.frame", "centre"}});
    const TypedStyle crossed = resolveStyle(testKeys(), sheet, {0, 0}).style;
    EXPECT_EQ(crossed.plane.crosshair, glm::dvec3(3, 4.5, -6));
    EXPECT_EQ(crossed.plane.units, PlaneUnits::World);
    EXPECT_EQ(crossed.camera.frame, FrameMode::Centre);
    const std::vector<nlohmann::json> refused{
        {{"plane.position", 1.5}}, {{"plane.axis", "x"}}, {{"plane.normal", {1, 2}}}};
    for (const nlohmann::json& wrong : refused)
        EXPECT_THROW(parseStyleMap(testKeys(), wrong), InvalidInput) << wrong.dump();
}

TEST(Style, LabelAndOverlayKeysReachTheTypedStyle) {
    Workbook workbook = filledWorkbook(1, 1);
    Sheet& sheet = workbook.sheets[0];
    EXPECT_EQ(resolveStyle(testKeys(), sheet, {0, 0}).style.labels, LabelsStyle{});
    sheet.style = parseStyleMap(testKeys(), nlohmann::json{{"labels.show", "on"},
                                                           {"labels.names", "1: liver"},
                                                           {"labels.hide", {{2}, {5}}},
                                                           {"labels.opacity", 0.5},
                                                           {"overlay.dataset", "B1"},
                                                           {"overlay.map", "labels"},
                                                           {"overlay.opacity", 0.25},
                                                           {"overlay.threshold", -3},
                                                           {"overlay.min", 1},
                                                           {"overlay.max", 4}});
    TypedStyle style = resolveStyle(testKeys(), sheet, {0, 0}).style;
    EXPECT_EQ(style.labels, (LabelsStyle{true, "1: liver", {2, 5}, 0.5}));
    EXPECT_EQ(style.overlay, (OverlayStyle{"B1", "labels", 0.25, -3.0, 1.0, 4.0}));
    EXPECT_NO_THROW(requireConsistent(style));
    style.overlay.max = 1.0;
    EXPECT_EQ(refusedField(style), "overlay.min");
    style.overlay.max = std::nullopt;
    style.labels.names = "liver";
    EXPECT_EQ(refusedField(style), "labels.names");
    for (const char* refused :
         {"labels.show=1", "labels.opacity=2", "overlay.opacity=-1", "overlay.map=nothing"})
        EXPECT_THROW((void)parseAssignment(testKeys(), refused), InvalidInput) << refused;
}

TEST(Style, PeriodsAreWholeNumbers) {
    TypedStyle style = resolveStyle(testKeys(), Workbook{}.sheets[0], {0, 0}).style;
    EXPECT_EQ(style.periodic, PeriodicStyle{});
    style.periodic.replicate = {2.0, 1.5, 1.0};
    EXPECT_EQ(refusedField(style), "periodic.replicate");
    style.periodic = {{0.5, -0.25, 0.0}, {2.0, 8.0, 1.0}};
    EXPECT_NO_THROW(requireConsistent(style));
    EXPECT_EQ(parseAssignment(testKeys(), "periodic.replicate=2,2,1").second,
              std::optional<StyleValue>(glm::dvec3(2.0, 2.0, 1.0)));
    for (const char* refused :
         {"periodic.replicate=9,1,1", "periodic.replicate=0,1,1", "periodic.shift=2,0,0"})
        EXPECT_THROW((void)parseAssignment(testKeys(), refused), InvalidInput) << refused;
}

TEST(Style, CrystalKeysBecomeTyped) {
    Workbook book;
    Sheet& sheet = book.sheets[0];
    EXPECT_EQ(resolveStyle(testKeys(), sheet, {0, 0}).style.crystal, CrystalStyle{});
    sheet.style = parseStyleMap(testKeys(), {{"crystal.cell", "on"},
                                             {"crystal.atoms", "on"},
                                             {"crystal.bonds", "across"},
                                             {"crystal.radius", 0.75}});
    EXPECT_EQ(resolveStyle(testKeys(), sheet, {0, 0}).style.crystal,
              (CrystalStyle{true, true, BondReach::Across, 0.75}));
    for (const char* refused :
         {"crystal.radius=0", "crystal.radius=5", "crystal.bonds=on", "crystal.atoms=1"})
        EXPECT_THROW((void)parseAssignment(testKeys(), refused), InvalidInput) << refused;
}

TEST(Style, DegenerateClipsPlanesAndLightsAreRefused) {
    const TypedStyle initial = resolveStyle(testKeys(), Workbook{}.sheets[0], {0, 0}).style;
    TypedStyle style = initial;
    style.clip.planes = {{glm::dvec3(0.0), 0.5}};
    EXPECT_EQ(refusedField(style), "clip.planes");
    style.clip.planes = {{glm::dvec3(1e300), 0.5}};
    EXPECT_EQ(refusedField(style), "clip.planes");
    style = initial;
    style.clip.box = ClipStyle::Box{glm::dvec3(0.5), glm::dvec3(1.0, 0.5, 1.0)};
    EXPECT_EQ(refusedField(style), "clip.box");
    style = initial;
    style.clip.transform.scale.y = 0.0;
    EXPECT_EQ(refusedField(style), "clip.transform");
    style = initial;
    style.light.directions = {glm::dvec3(0.0)};
    EXPECT_EQ(refusedField(style), "light.direction");
    style = initial;
    style.plane.normal = glm::dvec3(0.0);
    EXPECT_NO_THROW(requireConsistent(style)) << "not in use";
    style.plane.axis = PlaneAxis::Custom;
    EXPECT_EQ(refusedField(style), "plane.normal");
    style.plane.axis = PlaneAxis::Hkl;
    EXPECT_NO_THROW(requireConsistent(style));
    for (const glm::dvec3 hkl : {glm::dvec3(0.0), glm::dvec3(1.0, 0.5, 0.0)}) {
        style.plane.hkl = hkl;
        EXPECT_EQ(refusedField(style), "plane.hkl");
    }
    EXPECT_THROW((void)parseAssignment(testKeys(), "plane.hkl=100,0,0"), InvalidInput);
}

} // namespace
} // namespace voxsheet::sheet
