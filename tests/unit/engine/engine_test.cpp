// The facade without a renderer: imports by the real importer, workbook, formulas, files.
#include "base/errors.h"
#include "engine/engine.h"
#include "engine/shown_volumes.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

namespace voxsheet::engine {
namespace {

namespace fs = std::filesystem;

class EngineTest : public testing::Test {
protected:
    void SetUp() override {
        importer = fs::path(VOXSHEET_BINARY_DIR) / "voxsheet-import";
        if (!fs::exists(importer)) GTEST_SKIP() << "voxsheet-import is not built";
        fs::create_directories(data);
    }

    EngineOptions options() const {
        EngineOptions options;
        options.storeDir = folder.path() / "store";
        options.uploadDir = folder.path() / "uploads";
        options.roots = {data};
        options.importer = importer;
        options.render = false;
        return options;
    }

    /// An NRRD of bytes, all `value`.
    fs::path volume(const std::string& name, glm::ivec3 dims, unsigned char value) const {
        const fs::path file = data / name;
        fs::create_directories(file.parent_path());
        std::ofstream stream(file, std::ios::binary);
        stream << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " << dims.x << " " << dims.y << " " << dims.z
               << "\nspacings: 1 1 1\nencoding: raw\n\n"
               << std::string(static_cast<std::size_t>(dims.x * dims.y * dims.z), static_cast<char>(value));
        return file;
    }

    static ImportRequest request(const fs::path& file) {
        ImportRequest request;
        request.files = {file};
        return request;
    }

    static CellStatus status(const Engine& engine, const std::string& cell) {
        for (const CellStatus& each : engine.cellStatuses(*engine.snapshot(), "")) {
            if (sheet::addressName(each.cell) == cell) return each;
        }
        return {};
    }

    static void setSource(Engine& engine, const std::string& cell, const std::string& source) {
        engine.apply(
            sheet::SetSource{engine.snapshot()->sheets.front().name, sheet::parseAddress(cell), source});
    }

    test::TemporaryFolder folder;
    fs::path data = folder.path() / "data";
    fs::path importer;
};

TEST_F(EngineTest, FilesBecomeCellsInNaturalOrderWithShortNames) {
    Engine engine(options());
    const auto names = engine.importDatasets(
        {request(volume("run10/a.nrrd", {8, 8, 8}, 10)), request(volume("run2/a.nrrd", {8, 8, 8}, 2))});
    EXPECT_EQ(names, (std::vector<std::string>{"run2/a.nrrd", "run10/a.nrrd"}));
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "A1").state, CellState::Ready);
    EXPECT_EQ(status(engine, "A1").meta->fields[0].steps[0].statistics.max, 2);
    EXPECT_EQ(status(engine, "B1").meta->fields[0].steps[0].statistics.max, 10);
    const DatasetInfo info = engine.dataset("run2/a.nrrd");
    EXPECT_EQ(info.state, DatasetState::Ready);
    EXPECT_EQ(info.progress, 1.0);
    // What became known of the source is in the workbook.
    EXPECT_TRUE(engine.snapshot()->datasets.at("run2/a.nrrd").checksum.starts_with("xxh3:"));
    EXPECT_THROW(static_cast<void>(engine.dataset("no such")), NotFound);
}

TEST_F(EngineTest, ABadFileIsAnErrorInItsCellAndTheOthersGoOn) {
    Engine engine(options());
    const fs::path bad = volume("bad.nrrd", {8, 8, 8}, 1);
    fs::resize_file(bad, 200);
    engine.importDatasets({request(bad), request(volume("good.nrrd", {8, 8, 8}, 3))});
    ASSERT_TRUE(engine.waitIdle(60));
    const CellStatus broken = status(engine, "A1");
    EXPECT_EQ(broken.state, CellState::Error);
    EXPECT_EQ(broken.code, "#IMPORT!");
    EXPECT_GT(broken.message.size(), 20U);
    EXPECT_EQ(status(engine, "B1").state, CellState::Ready);
    EXPECT_EQ(engine.dataset("bad.nrrd").state, DatasetState::Failed);
    const PreparedTile tile = engine.prepareTile(*engine.snapshot(), "", {0, 0}, {}, {});
    EXPECT_EQ(tile.code, "#IMPORT!");
    EXPECT_FALSE(tile.spec);
    EXPECT_FALSE(tile.identity.empty());
}

TEST_F(EngineTest, FilesOutsideTheRootsAndAbsentOnesAreRefusedBeforeAnythingChanges) {
    Engine engine(options());
    std::ofstream(folder.path() / "outside.nrrd") << "x";
    EXPECT_THROW(engine.importDatasets({request(folder.path() / "outside.nrrd")}), InvalidInput);
    EXPECT_THROW(engine.importDatasets({request(data / "absent.nrrd")}), NotFound);
    EXPECT_TRUE(engine.datasets().empty());
    EXPECT_FALSE(engine.canUndo());
}

TEST_F(EngineTest, FormulasAreComputedAndShowErrorsAsValues) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {8, 8, 8}, 30)),
                           request(volume("c.nrrd", {9, 8, 8}, 30))});
    setSource(engine, "B2", "=B1-A1*2");
    ASSERT_TRUE(engine.waitIdle(60));
    ASSERT_EQ(status(engine, "B2").state, CellState::Ready) << status(engine, "B2").message;
    EXPECT_EQ(status(engine, "B2").meta->format, "formula");
    EXPECT_EQ(status(engine, "B2").meta->fields[0].steps[0].statistics.max, 10);
    setSource(engine, "B2", "=A1+A2");
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "B2").code, "#GRID!");
    EXPECT_NE(status(engine, "B2").message.find("9"), std::string::npos) << "the sentence names the shapes";
    setSource(engine, "B2", "=B2+A1");
    EXPECT_EQ(status(engine, "B2").code, "#CYCLE!");
    setSource(engine, "B2", "=foo(A1)");
    EXPECT_EQ(status(engine, "B2").code, "#NAME?");
    ASSERT_TRUE(engine.undo());
    EXPECT_EQ(status(engine, "B2").code, "#CYCLE!");
}

TEST_F(EngineTest, ProbesGiveSourceValuesAndSayWhereThereIsNone) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {4, 4, 4}, 20))});
    ASSERT_TRUE(engine.waitIdle(60));
    const auto meta = status(engine, "A1").meta;
    const glm::dvec3 world(meta->grid.worldFromIndex * glm::dvec4(6.2, 5.0, 7.0, 1.0));
    const auto values = engine.probeWorld("", world);
    ASSERT_EQ(values.size(), 2U);
    EXPECT_EQ(values[0].value, 10.0);
    EXPECT_EQ(values[0].index, glm::ivec3(6, 5, 7));
    EXPECT_FALSE(values[1].value);
    EXPECT_EQ(values[1].note, "outside");
    EXPECT_TRUE(engine.probePixel("", {0, 0}, {}, {0, 0}, {100, 100}).empty()) << "beside the volume";
    const auto under = engine.probePixel("", {0, 0}, {}, {50, 50}, {100, 100});
    ASSERT_EQ(under.size(), 2U);
    EXPECT_EQ(under[0].value, 10.0);
}

TEST_F(EngineTest, IdentitiesFollowEveryEditAndNothingElse) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {8, 8, 8}, 20))});
    ASSERT_TRUE(engine.waitIdle(60));
    const auto identity = [&](const sheet::Address& cell, const View& view = {}) {
        return engine.prepareTile(*engine.snapshot(), "", cell, view, {}).identity;
    };
    const std::string a = identity({0, 0});
    const std::string b = identity({1, 0});
    EXPECT_NE(a, b);
    EXPECT_EQ(a, identity({0, 0}));
    sheet::SetStyle edit{engine.snapshot()->sheets.front().name,
                         sheet::Layer::ofCell({1, 0}),
                         {{"camera.azimuth", 77.0}},
                         false};
    engine.apply(edit);
    EXPECT_EQ(a, identity({0, 0})) << "the other cell's picture stays";
    EXPECT_NE(b, identity({1, 0}));
    View moved;
    moved.all["camera.azimuth"] = 10.0;
    EXPECT_NE(a, identity({0, 0}, moved));
    EXPECT_EQ(identity({1, 0}), identity({1, 0}, moved)) << "an override is not linked";
}

TEST_F(EngineTest, ARequestsBadValueIsThrownAndACellsOwnIsShown) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    View asked;
    asked.request["field"] = std::string("velocity");
    EXPECT_THROW(static_cast<void>(engine.prepareTile(*engine.snapshot(), "", {0, 0}, asked, {})),
                 InvalidInput);
    engine.apply(
        sheet::SetStyle{"Sheet1", sheet::Layer::sheet(), {{"field", std::string("velocity")}}, false});
    const PreparedTile tile = engine.prepareTile(*engine.snapshot(), "", {0, 0}, {}, {});
    EXPECT_EQ(tile.code, "#REF!");
    EXPECT_FALSE(tile.spec);
}

TEST_F(EngineTest, TheColourBarTellsRangeAndStops) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    EXPECT_GE(engine.colourMaps()["maps"].size(), 12U);
    ASSERT_TRUE(engine.waitIdle(60));
    View view;
    view.request["range.mode"] = std::string("fixed");
    view.request["range.min"] = -1.0;
    view.request["range.max"] = 4.0;
    const auto bar = engine.colourBar("", {0, 0}, view);
    EXPECT_EQ(bar["low"], -1.0);
    EXPECT_EQ(bar["high"], 4.0);
    EXPECT_EQ(bar["stops"].size(), 64U);
    EXPECT_GE(bar["ticks"].size(), 2U);
    EXPECT_THROW(static_cast<void>(engine.colourBar("", {0, 5}, {})), Error);
}

TEST_F(EngineTest, ASavedWorkbookOpensAgainEvenWhenMovedWithItsData) {
    fs::path book = data / "books" / "one.json";
    fs::create_directories(book.parent_path());
    {
        Engine engine(options());
        engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
        engine.apply(sheet::InsertLines{"Sheet1", sheet::Axis::Rows, 1, 1});
        setSource(engine, "A2", "=A1*2");
        ASSERT_TRUE(engine.waitIdle(60));
        EXPECT_TRUE(engine.saveRecovery());
        engine.saveWorkbook(book);
        EXPECT_FALSE(engine.saveRecovery()) << "everything is saved";
    }
    std::ifstream stream(book);
    const auto document = nlohmann::json::parse(stream);
    EXPECT_NE(document.dump().find("../a.nrrd"), std::string::npos);
    fs::create_directories(data / "moved" / "books");
    fs::rename(data / "a.nrrd", data / "moved" / "a.nrrd");
    Engine engine(options());
    engine.setWorkbookJson(document, data / "moved" / "books");
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "A1").state, CellState::Ready) << status(engine, "A1").message;
    EXPECT_EQ(status(engine, "A2").state, CellState::Ready) << status(engine, "A2").message;
    // Opened where the data is not, the cell says so and the document is kept.
    engine.setWorkbookJson(document, data / "books");
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "A1").code, "#IMPORT!");
    EXPECT_EQ(status(engine, "A2").code, "#IMPORT!") << "a formula hands on the error of what it reads";
    EXPECT_EQ(engine.workbookJson()["datasets"].size(), 1U);
}

TEST_F(EngineTest, ADocumentThatIsInNoFileIsKeptForRecovery) {
    Engine engine(options());
    const nlohmann::json document{{"voxsheet", 1},
                                  {"title", "sent over the network"},
                                  {"sheets", {{{"name", "Mine"}, {"columns", 1}, {"rows", 1}}}}};
    engine.setWorkbookJson(document, data, DocumentOrigin::File);
    EXPECT_FALSE(engine.saveRecovery()) << "it stands in its file";
    auto edited = document;
    edited["title"] = "edited by a script";
    engine.setWorkbookJson(edited, data);
    EXPECT_TRUE(engine.saveRecovery());
}

TEST_F(EngineTest, ABrokenDocumentChangesNothing) {
    Engine engine(options());
    const auto version = engine.version();
    EXPECT_THROW(engine.setWorkbookJson({{"voxsheet", 1}, {"surprise", true}}, data), Error);
    EXPECT_EQ(engine.version(), version);
}

TEST_F(EngineTest, UploadsAreKeptAsSourcesUnderASafeName) {
    Engine engine(options());
    const fs::path received = volume("incoming.tmp", {8, 8, 8}, 5);
    const std::string name = engine.importUpload("scan", received, "../../evil/scan.nrrd");
    EXPECT_EQ(name, "scan");
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(engine.dataset("scan").state, DatasetState::Ready);
    EXPECT_EQ(engine.dataset("scan").files.front(), folder.path() / "uploads" / "scan.nrrd");
    EXPECT_FALSE(fs::exists(received));
    EXPECT_THROW(engine.importUpload("scan", volume("again.tmp", {8, 8, 8}, 5), "scan.nrrd"), Conflict);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "uploads"), {}), 1)
        << "nothing is left of it";
}

TEST_F(EngineTest, AFileThatChangedIsReadAnewWhenItIsOpenedAgain) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    const std::string before = status(engine, "A1").meta->key;
    engine.importDatasets({request(data / "a.nrrd")});
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "A1").meta->key, before) << "nothing changed";
    engine.importDatasets({request(volume("a.nrrd", {9, 8, 8}, 11))});
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "A1").meta->grid.dims.x, 9) << "cells that show the file follow";
}

TEST_F(EngineTest, RemovingADatasetCanBeUndone) {
    Engine engine(options());
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    engine.removeDataset("a.nrrd");
    EXPECT_TRUE(engine.datasets().empty());
    EXPECT_EQ(status(engine, "A1").state, CellState::Empty);
    ASSERT_TRUE(engine.undo());
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_EQ(status(engine, "A1").state, CellState::Ready);
}

TEST_F(EngineTest, ListenersHearOfEditsAndDatasetsUntilTheyAreRemoved) {
    Engine engine(options());
    std::atomic<int> edits{0};
    std::atomic<int> imports{0};
    const auto id = engine.addListener(
        [&](ChangeKind kind, std::uint64_t) { ++(kind == ChangeKind::Workbook ? edits : imports); });
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_GE(edits, 1);
    EXPECT_GE(imports, 1);
    engine.removeListener(id);
    const int before = edits;
    setSource(engine, "A1", "");
    EXPECT_EQ(edits, before);
}

TEST_F(EngineTest, ManyThreadsMayEditAndAskAtOnce) {
    Engine engine(options());
    engine.importDatasets(
        {request(volume("a.nrrd", {8, 8, 8}, 10)), request(volume("b.nrrd", {8, 8, 8}, 20))});
    engine.apply(sheet::InsertLines{"Sheet1", sheet::Axis::Rows, 1, 1});
    setSource(engine, "A2", "=B1-A1");
    std::vector<std::thread> threads;
    std::atomic<int> failures{0};
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 40; ++i) {
                try {
                    const sheet::StylePatch patch{{"camera.azimuth", static_cast<double>(t * 40 + i)}};
                    engine.apply(sheet::SetStyle{"Sheet1", sheet::Layer::ofCell({t % 2, 0}), patch, false},
                                 "drag" + std::to_string(t));
                    static_cast<void>(engine.prepareTile(*engine.snapshot(), "", {t % 2, t / 2}, {}, {}));
                    static_cast<void>(engine.cellStatuses(*engine.snapshot(), ""));
                    if (i % 10 == 0) engine.undo();
                } catch (const NotFound&) {
                    // An undo of another thread took the cell away.
                } catch (...) {
                    ++failures;
                }
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(failures, 0);
    ASSERT_TRUE(engine.waitIdle(60));
}

TEST_F(EngineTest, WithoutARendererPicturesAreRefusedClearly) {
    Engine engine(options());
    EXPECT_EQ(engine.device(), nullptr);
    EXPECT_EQ(engine.residency().textures, 0);
    engine.importDatasets({request(volume("a.nrrd", {8, 8, 8}, 10))});
    ASSERT_TRUE(engine.waitIdle(60));
    EXPECT_THROW(static_cast<void>(engine.renderSheet({})), Unsupported);
}

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
    EXPECT_EQ(volumesOf(*tile.spec, WantedPriority::Visible).size(), 4U);
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
