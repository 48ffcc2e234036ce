#include "engine_fixture.h"

namespace voxsheet::engine {
namespace {

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

} // namespace
} // namespace voxsheet::engine
