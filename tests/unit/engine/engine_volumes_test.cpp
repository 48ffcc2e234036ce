#include "engine_fixture.h"

namespace voxsheet::engine {
namespace {

TEST_F(EngineTest, AClipObjectOfDataIsComputedWhenACellAsksForItAndServesAllOfThem) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {8, 8, 8}, 20)),
                           request(volume("c.nrrd", {8, 8, 8}, 1))});
    ASSERT_TRUE(engine.waitIdle(60));
    setSource(engine, "B2", "=A1+B1");
    ASSERT_TRUE(engine.waitIdle(60));
    const auto prepare = [&](const char* cell, const View& view = {}) {
        return engine.prepareTile(*engine.snapshot(), "", sheet::parseAddress(cell), view, {});
    };
    std::atomic<int> told{0};
    const auto listener = engine.addListener(
        [&](ChangeKind kind, std::uint64_t) { told += kind == ChangeKind::Datasets ? 1 : 0; });
    engine.apply(
        sheet::SetStyle{"Sheet1", sheet::Layer::sheet(), {{"clip.shape", std::string("B2 > 15")}}, false});
    const PreparedTile first = prepare("A1");
    if (!first.spec) { // Else the computation was faster than we.
        EXPECT_EQ(first.code, "") << first.message;
        EXPECT_LT(first.progress, 1.0);
        EXPECT_NE(first.message.find("B2 > 15"), std::string::npos) << first.message;
    }
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_GT(told, 0) << "a page hears that it can draw";
    const PreparedTile a = prepare("A1");
    const PreparedTile b = prepare("B1");
    ASSERT_TRUE(a.spec && b.spec) << a.message << b.message;
    ASSERT_TRUE(a.spec->clip.object && b.spec->clip.object);
    EXPECT_EQ(a.spec->clip.object->dataset, b.spec->clip.object->dataset);
    EXPECT_EQ(a.spec->clip.object->objectFromWorld, glm::dmat4(1.0)) << "of the same grid";
    EXPECT_EQ(a.progress, 1.0);

    View view;
    view.cells[{0, 0}] = {{"clip.shape", std::string("C9 > 1")}};
    EXPECT_EQ(prepare("A1", view).code, "#REF!");
    EXPECT_NE(prepare("A1", view).message.find("C9"), std::string::npos);
    view.cells.clear();
    view.request = {{"clip.shape", std::string("C9 > 1")}};
    EXPECT_THROW(static_cast<void>(prepare("A1", view)), InvalidInput) << "the caller sent it";
    setSource(engine, "B2", "=A1+nonsense");
    EXPECT_EQ(prepare("A1").code, "#NAME?") << prepare("A1").message;
    engine.removeListener(listener);
}

TEST_F(EngineTest, SurfacesColouredByAnotherCellSpanThatCellsValues) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {40, 40, 40}, 20))});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    view.all = {{"technique", std::string("isosurface")},
                {"isosurface.colorBy", std::string("B1")},
                {"range.mode", std::string("fixed")},
                {"range.min", 0.0},
                {"range.max", 1.0}};
    TileQuality coarse;
    coarse.level = 9;
    const PreparedTile tile = engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, coarse);
    ASSERT_TRUE(tile.spec) << tile.message;
    ASSERT_TRUE(tile.spec->isosurface.colouredBy);
    const ColourVolume& by = *tile.spec->isosurface.colouredBy;
    EXPECT_EQ(by.dataset, status(engine, "B1").meta->key);
    EXPECT_EQ(by.level, tile.spec->level) << "A1 has one level, B1 two: as fine as the cell itself";
    EXPECT_EQ(by.transfer->low, 10.0) << "20, widened by half: its own range, not what was typed for A1";
    EXPECT_EQ(by.transfer->high, 30.0);
    view.all["technique"] = std::string("raycast");
    EXPECT_FALSE(engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {}).spec->isosurface.colouredBy);
}

TEST_F(EngineTest, LayersLookAsTheirOwnCellsDo) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {40, 40, 40}, 20))});
    ASSERT_TRUE(engine.waitIdle(60));
    engine.apply(sheet::InsertLines{"Sheet1", sheet::Axis::Rows, 1, 1});
    setSource(engine, "A2", "=B1*2");
    ASSERT_TRUE(engine.waitIdle(60));
    engine.apply(sheet::SetStyle{"Sheet1",
                                 sheet::Layer::ofCell({1, 0}),
                                 {{"transfer.map", std::string("inferno")},
                                  {"transfer.unitLength", 3.5},
                                  {"texture.format", std::string("half")}},
                                 false});
    const auto prepare = [&](const char* cell, const View& view) {
        return engine.prepareTile(*engine.snapshot(), "", sheet::parseAddress(cell), view, {});
    };
    View view;
    view.all = {{"layers", std::string("B1; a2; b.nrrd")},
                {"layers.weights", sheet::NumberTable{{{0.5}, {0.25}}}}};
    const PreparedTile b = prepare("B1", {});
    const PreparedTile tile = prepare("A1", view);
    ASSERT_TRUE(tile.spec && b.spec) << tile.message << b.message;
    const LayersSpec& layers = tile.spec->layers;
    EXPECT_EQ(layers.ownWeight, 0.5);
    ASSERT_EQ(layers.volumes.size(), 3U);
    const VolumeLayer& first = layers.volumes[0];
    EXPECT_EQ(first.dataset, b.spec->dataset);
    EXPECT_EQ(*first.transfer, *b.spec->transfer);
    EXPECT_EQ(first.unitLengthWorld, 3.5);
    EXPECT_EQ(first.floatTexels, FloatTexels::Half);
    EXPECT_EQ(first.weight, 0.25);
    EXPECT_EQ(layers.volumes[1].dataset, status(engine, "A2").meta->key);
    EXPECT_EQ(layers.volumes[2].dataset, b.spec->dataset);
    EXPECT_EQ(layers.volumes[2].unitLengthWorld, 1.0) << "a dataset by its name has the default look";
    EXPECT_FALSE(*layers.volumes[2].transfer == *first.transfer);
    EXPECT_EQ(layers.volumes[2].weight, 0.25) << "the last weight repeats";
    const auto linked = prepare("B1", view);
    ASSERT_TRUE(linked.spec) << linked.message;
    EXPECT_EQ(linked.spec->layers.volumes.size(), 2U) << "a cell that names itself is not blended twice";
    const auto bars = engine.colourBar("", {0, 0}, view).at("layers");
    ASSERT_EQ(bars.size(), 3U);
    EXPECT_EQ(bars[1].at("name"), "A2");
    EXPECT_EQ(bars[1].at("weight"), 0.25);
    EXPECT_EQ(engine.volumesOf(*tile.spec, WantedPriority::Visible).size(), 4U);
}

TEST_F(EngineTest, ATileNeedsTheBytesOfItsLayersAndOfWhatColoursItsSurfaces) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {16, 8, 8}, 40))});
    ASSERT_TRUE(engine.waitIdle(60));
    const auto needs = [&](const sheet::Address& cell, const sheet::StyleMap& style) {
        View view;
        view.all = style;
        return engine.prepareTile(*engine.snapshot(), "", cell, view, {}).needs;
    };
    const LevelNeeds own = needs({1, 0}, {});
    EXPECT_TRUE(needs({0, 0}, {}).further.empty());
    for (const sheet::StyleMap& style : {sheet::StyleMap{{"layers", std::string("B1")}},
                                         sheet::StyleMap{{"technique", std::string("isosurface")},
                                                         {"isosurface.colorBy", std::string("B1")}}}) {
        const LevelNeeds fused = needs({0, 0}, style);
        ASSERT_EQ(fused.further.size(), 1U);
        EXPECT_EQ(fused.further[0].volume, own.volume);
        EXPECT_EQ(fused.further[0].textureBytes, own.textureBytes);
    }
}

TEST_F(EngineTest, ATileNeedsTheBytesOfItsClipObject) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    const auto further = [&](const std::string& shape) {
        View view;
        view.all["clip.shape"] = shape;
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        for (;;) { // the distances of a threshold are computed first
            const auto tile = engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {});
            if (tile.spec || std::chrono::steady_clock::now() > deadline) return tile.needs.further;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    };
    const auto sphere = further("sphere");
    ASSERT_EQ(sphere.size(), 1U);
    EXPECT_EQ(sphere[0].textureBytes, (std::vector<std::uint64_t>{81U * 81 * 81 * 4}));
    const auto threshold = further("A1 > 0.4");
    ASSERT_EQ(threshold.size(), 1U);
    EXPECT_EQ(threshold[0].textureBytes.size(), 1U);
    EXPECT_NE(threshold[0].volume, sphere[0].volume);
}

TEST_F(EngineTest, TheProbeReadsEveryLayer) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {4, 4, 4}, 40))});
    ASSERT_TRUE(engine.waitIdle(60));
    engine.apply(
        sheet::SetStyle{"Sheet1", sheet::Layer::sheet(), {{"layers", std::string("A1; B1")}}, false});
    const auto inside = engine.probeWorld("", {1.0, 1.0, 1.0});
    ASSERT_EQ(inside.size(), 2U);
    ASSERT_EQ(inside[0].layers.size(), 1U) << "a cell that names itself is not blended twice";
    EXPECT_EQ(inside[0].layers[0].name, "B1");
    EXPECT_EQ(inside[0].value, 10.0);
    EXPECT_EQ(inside[0].layers[0].value, 40.0);
    EXPECT_EQ(inside[0].layers[0].interpolated, 40.0);
    ASSERT_EQ(inside[1].layers.size(), 1U);
    EXPECT_EQ(inside[1].layers[0].value, 10.0);
    const auto beside = engine.probeWorld("", {6.0, 6.0, 6.0}); // B1 ends at 3
    EXPECT_EQ(beside[0].value, 10.0);
    EXPECT_FALSE(beside[0].layers[0].value);
    EXPECT_EQ(beside[0].layers[0].note, "outside");
    View slices;
    slices.all["layers"] = sheet::None{};
    const auto pixel = engine.probePixel("", {0, 0}, {}, {64, 64}, {128, 128});
    ASSERT_FALSE(pixel.empty());
    EXPECT_EQ(pixel[0].layers.size(), 1U);
    EXPECT_TRUE(engine.probePixel("", {0, 0}, slices, {64, 64}, {128, 128})[0].layers.empty());
}

TEST_F(EngineTest, LayersThatCannotBeBlendedSayWhy) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    engine.apply(sheet::InsertLines{"Sheet1", sheet::Axis::Columns, 1, 2});
    const auto prepare = [&](const char* layers, const char* technique = "raycast") {
        View view;
        view.cells[{0, 0}] = {{"layers", std::string(layers)}, {"technique", std::string(technique)}};
        return engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {});
    };
    for (const char* layers : {"B1", "C9", "nothing", "Sheet9!A1", "B1;;", "B1;B1;B1;B1"}) {
        const auto tile = prepare(layers);
        EXPECT_EQ(tile.code, "#REF!") << layers;
        EXPECT_NE(tile.message.find("layers"), std::string::npos) << tile.message;
    }
    for (const char* technique : {"slices", "mip", "surface", "isosurface"}) {
        const auto tile = prepare("a.nrrd", technique);
        EXPECT_EQ(tile.code, "#TYPE!") << technique;
        EXPECT_NE(tile.message.find("layers"), std::string::npos) << tile.message;
        EXPECT_NE(tile.message.find("raycast"), std::string::npos) << tile.message;
        EXPECT_TRUE(prepare("A1", technique).spec) << "the cell alone is nothing to blend";
    }
    setSource(engine, "B1", "=A1+nonsense");
    EXPECT_EQ(prepare("B1").code, "#NAME?");
    setSource(engine, "B1", "=C1");
    setSource(engine, "C1", "=B1");
    EXPECT_EQ(prepare("B1").code, "#CYCLE!");
}

TEST_F(EngineTest, TheColourBarMarksTheSurfacesAndExplainsWhatColoursThem) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {8, 8, 8}, 40))});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    const auto bar = [&] { return engine.colourBar("", {0, 0}, view); };
    EXPECT_TRUE(bar().at("isovalues").empty());
    EXPECT_TRUE(bar().at("colouredBy").is_null());
    view.all = {{"technique", std::string("isosurface")},
                {"isovalue", sheet::NumberTable{{{7.5}, {99.0}}}},
                {"isosurface.opacity", sheet::NumberTable{{{0.5}}}}};
    const auto marked = bar();
    ASSERT_EQ(marked.at("isovalues").size(), 2U);
    EXPECT_EQ(marked["isovalues"][0].at("value"), 7.5);
    EXPECT_EQ(marked["isovalues"][0].at("position"), 0.25) << "the bar spans 5 to 15";
    EXPECT_EQ(marked["isovalues"][0].at("opacity"), 0.5);
    EXPECT_EQ(marked["isovalues"][0].at("colour").size(), 3U);
    EXPECT_TRUE(marked["isovalues"][1].at("position").is_null());
    view.all["isosurface.colorBy"] = std::string("B1");
    const auto coloured = bar().at("colouredBy");
    EXPECT_EQ(coloured.at("low"), 20.0);
    EXPECT_EQ(coloured.at("high"), 60.0);
    EXPECT_EQ(coloured.at("stops").size(), 64U);
    EXPECT_FALSE(coloured.at("ticks").empty());
}

TEST_F(EngineTest, ATileWhoseSurfacesLieOutsideItsDataSaysSoAndIsNoError) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {8, 8, 8}, 40))});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    view.all = {{"technique", std::string("isosurface")},
                {"isovalue", sheet::NumberTable{{{10.0}}}},
                {"range.mode", std::string("shared")}};
    const auto prepare = [&](const sheet::Address& cell) {
        return engine.prepareTile(*engine.snapshot(), "", cell, view, {});
    };
    EXPECT_EQ(prepare({0, 0}).note, "");
    const PreparedTile other = prepare({1, 0});
    ASSERT_TRUE(other.spec) << other.message;
    EXPECT_NE(other.note.find("go from 40 to 40"), std::string::npos)
        << "its own values, not those of the shared range: " << other.note;
    view.all.erase("technique");
    EXPECT_EQ(prepare({1, 0}).note, "");
}

TEST_F(EngineTest, RangesAreSharedByCellsOfOneQuantityAndUnit) {
    Engine engine(options());
    // Files of VASP say by their names what they hold.
    const auto grid = [&](const std::string& name, double largest) {
        std::ofstream stream(data / name);
        stream << "one atom\n 1.0\n 2 0 0\n 0 2 0\n 0 0 2\n Na\n 1\nDirect\n 0 0 0\n\n 2 2 2\n";
        for (int i = 0; i < 8; ++i)
            stream << (i == 0 ? largest : 1.0) << "\n";
        return data / name;
    };
    engine.importDatasets(
        {request(grid("CHGCAR_a", 16.0)), request(grid("CHGCAR_b", 64.0)), request(grid("LOCPOT_c", 90.0))});
    ASSERT_TRUE(engine.waitIdle(60));
    sheet::SetStyle shared{engine.snapshot()->sheets.front().name, sheet::Layer::sheet(), {}};
    shared.patch = sheet::parseStylePatch(engine.keys(), {{"range.mode", "shared"}});
    engine.apply(shared);
    // Placed two to a row: A1, B1, A2.
    const auto bar = [&](int cell) { return engine.colourBar("", {cell % 2, cell / 2}, {}); };
    ASSERT_NE(bar(0).at("quantity"), bar(2).at("quantity"));
    EXPECT_EQ(bar(0).at("high"), bar(1).at("high"));
    EXPECT_GT(bar(2).at("high"), 2.0 * bar(1).at("high").get<double>()) << "a potential is no density";
    EXPECT_EQ(bar(0).at("high"), bar(1).at("high")) << "again, from what was kept";
    EXPECT_TRUE(bar(2).at("shared"));
}

TEST_F(EngineTest, ValueRangesAreThoseOfTheStepOfAllStepsAndOfThePicture) {
    Engine engine(options());
    const fs::path series = data / "t.nrrd";
    {
        std::ofstream stream(series, std::ios::binary);
        stream << "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 8 8 8 2\nkinds: domain domain domain time\n"
               << "centers: node node node ???\nspacings: 1 1 1 1\nencoding: raw\n\n";
        for (int i = 0; i < 2 * 8 * 8 * 8; ++i)
            stream.put(static_cast<char>(10 * (i % 8) + (i < 8 * 8 * 8 ? 0 : 100)));
    }
    engine.importDatasets({request(series)});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    view.all["technique"] = std::string("plane");
    view.all["plane.axis"] = std::string("sagittal");
    view.all["plane.position"] = 3.0 / 7.0; // on the samples of x = 3
    const auto range = [&](RangeOver over) { return engine.valueRange("", {0, 0}, view, over, {64, 64}); };
    EXPECT_EQ(range(RangeOver::Data), (ValueExtremes{0.0, 70.0}));
    EXPECT_EQ(range(RangeOver::Time), (ValueExtremes{0.0, 170.0}));
    EXPECT_EQ(range(RangeOver::Visible), (ValueExtremes{30.0, 30.0}));
    view.all["time"] = std::int64_t{1};
    EXPECT_EQ(range(RangeOver::Data), (ValueExtremes{100.0, 170.0}));
    EXPECT_THROW(static_cast<void>(engine.valueRange("", {0, 1}, view, RangeOver::Data, {64, 64})), Error);
}

TEST_F(EngineTest, ACellWithoutACrystalThatIsAskedForOneSaysSoAndIsNoError) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    const auto prepare = [&] { return engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {}); };
    const PreparedTile plain = prepare();
    view.all = {{"crystal.atoms", std::string("on")}, {"crystal.cell", std::string("on")}};
    const PreparedTile asked = prepare();
    ASSERT_TRUE(asked.spec) << asked.message;
    EXPECT_NE(asked.note.find("no crystal is drawn"), std::string::npos) << asked.note;
    EXPECT_EQ(asked.identity, plain.identity) << "the picture is the same";
    EXPECT_EQ(plain.note, "");
}

TEST_F(EngineTest, AProbeSaysWhatLiesUnderThePixel) {
    Engine engine(options());
    const fs::path ramp = data / "a.nrrd";
    {
        std::ofstream stream(ramp, std::ios::binary);
        stream << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 16 16 16\nspacings: 1 1 1\nencoding: raw\n\n";
        for (int i = 0; i < 16 * 16 * 16; ++i)
            stream.put(static_cast<char>(10 * (i % 16)));
    }
    engine.importDatasets({request(ramp), request(volume("b.nrrd", {16, 16, 16}, 20))});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    view.all = {{"technique", std::string("isosurface")},
                {"isovalue", sheet::NumberTable{{{75.0}}}},
                {"camera.azimuth", 90.0},
                {"camera.elevation", 0.0}};
    auto values = engine.probePixel("", {0, 0}, view, {50, 50}, {100, 100});
    ASSERT_EQ(values.size(), 2U);
    EXPECT_EQ(values[0].hit, "isosurface");
    EXPECT_EQ(values[0].isovalue, 75.0);
    EXPECT_NEAR(values[0].interpolated.value(), 75.0, 1e-3);
    EXPECT_EQ(values[1].hit, "") << "only where the pixel is";
    EXPECT_EQ(values[1].interpolated, 20.0);
    view.all["clip.shape"] = std::string("B1 > 1"); // all of it
    EXPECT_TRUE(engine.probePixel("", {0, 0}, view, {50, 50}, {100, 100}).empty()) << "not there yet";
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_TRUE(engine.probePixel("", {0, 0}, view, {50, 50}, {100, 100}).empty()) << "cut away";
    view.all["clip.mode"] = std::string("probe");
    EXPECT_EQ(engine.probePixel("", {0, 0}, view, {50, 50}, {100, 100}).at(0).hit, "isosurface");
    view.all["technique"] = std::string("surface");
    EXPECT_EQ(engine.probePixel("", {0, 0}, view, {50, 50}, {100, 100}).at(0).hit, "face");
    view.all["technique"] = std::string("raycast");
    view.all["probe.opacity"] = 0.0;
    EXPECT_EQ(engine.probePixel("", {0, 0}, view, {50, 50}, {100, 100}).at(0).hit, "sample");
    EXPECT_EQ(engine.probeWorld("", {5, 5, 5}).at(0).hit, "");
}

TEST_F(EngineTest, ADraggedThresholdIsComputedWhereItComesToRestAndNotForEveryValueOnItsWay) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {150, 150, 150}, 10)), request(volume("b.nrrd", {8, 8, 8}, 1))});
    ASSERT_TRUE(engine.waitIdle(60));
    const auto entries = [&] {
        std::ptrdiff_t count = 0;
        for (const auto& each : fs::directory_iterator(options().storeDir))
            count += each.path().filename().string().size() == 32 ? 1 : 0; // a store key
        return count;
    };
    ASSERT_EQ(entries(), 2);
    View view;
    const auto ask = [&](int value) {
        view.all["clip.shape"] = "A1 > " + std::to_string(value);
        return engine.prepareTile(*engine.snapshot(), "", {1, 0}, view, {});
    };
    constexpr int kValues = 60;
    for (int value = 0; value < kValues; ++value)
        EXPECT_EQ(ask(value).code, "");
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_TRUE(ask(kValues - 1).spec);
    // The first one has begun when the others come; each takes far longer than asking for all of them.
    EXPECT_LT(entries(), 2 + kValues / 4);
}

/// The surface of the cube [0, edge]^3.
std::string cubeStl(double edge) {
    static constexpr int corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                           {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    std::ostringstream text;
    text << "solid cube\n";
    for (const auto& triangle : corners) {
        text << "facet normal 0 0 0\nouter loop\n";
        for (const int c : triangle)
            text << "vertex " << edge * (c & 1) << " " << edge * ((c >> 1) & 1) << " " << edge * (c >> 2)
                 << "\n";
        text << "endloop\nendfacet\n";
    }
    text << "endsolid cube\n";
    return text.str();
}

TEST_F(EngineTest, AMeshIsAClipObjectWithoutACellOfItsOwn) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ImportRequest mesh = request(data / "cube.stl");
    std::ofstream(data / "cube.stl") << cubeStl(3.0);
    mesh.place = false;
    mesh.name = "cube";
    engine.importDatasets({mesh});
    ASSERT_TRUE(engine.waitIdle(60));
    if (engine.dataset("cube").state == DatasetState::Failed)
        GTEST_SKIP() << engine.dataset("cube").failure->message;
    View view;
    view.all = {{"clip.shape", std::string("cube")}};
    const PreparedTile tile = engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {});
    ASSERT_TRUE(tile.spec) << tile.message;
    ASSERT_TRUE(tile.spec->clip.object);
    EXPECT_EQ(tile.spec->clip.object->dataset, engine.dataset("cube").meta->key);
    const glm::dvec3 centre(tile.spec->clip.object->objectFromWorld *
                            glm::dvec4(centreWorld(status(engine, "A1").meta->grid), 1.0));
    EXPECT_NEAR(glm::distance(centre, glm::dvec3(1.5)), 0.0, 0.1) << "the mesh's centre in the volume's";

    setSource(engine, "A1", "cube");
    ASSERT_TRUE(engine.waitIdle(60));
    view.all = {{"technique", std::string("isosurface")}};
    const PreparedTile shown = engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {});
    ASSERT_TRUE(shown.spec) << shown.message;
    ASSERT_EQ(shown.spec->isosurface.surfaces.size(), 1U);
    EXPECT_EQ(shown.spec->isosurface.surfaces[0].value, 0.0) << "the mesh itself";
}

TEST_F(EngineTest, AMeshThatCannotBeReadIsTheCellsError) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    std::ofstream(data / "open.stl")
        << "solid open\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 0 1 0\nendloop\nendfacet\nendsolid open\n";
    ImportRequest mesh = request(data / "open.stl");
    mesh.place = false;
    mesh.name = "open";
    engine.importDatasets({mesh});
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    view.all = {{"clip.shape", std::string("open")}};
    const PreparedTile tile = engine.prepareTile(*engine.snapshot(), "", {0, 0}, view, {});
    EXPECT_FALSE(tile.spec);
    EXPECT_EQ(tile.code, "#IMPORT!");
    EXPECT_EQ(tile.message, engine.dataset("open").failure->message);
}

} // namespace
} // namespace voxsheet::engine
