// What a page is sent: levels of detail, only what is visible and dirty, and nothing at rest. Counted, not
// timed.
#include "base/errors.h"
#include "engine/engine.h"
#include "stream/message.h"
#include "stream/stream_hub.h"
#include "stream/time_measurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include <unistd.h>

namespace voxsheet::stream {
namespace {

namespace fs = std::filesystem;

constexpr int kEdge = 64; ///< samples per axis: levels 0, 1 and 2
constexpr int kColumns = 5;

/// What came until the stream said that it has nothing more to send.
struct Received {
    std::vector<nlohmann::json> tiles;
    std::vector<nlohmann::json> errors;
    double drawnPixels = 0.0;
    [[nodiscard]] std::set<std::string> cells() const {
        std::set<std::string> names;
        for (const auto& tile : tiles)
            names.insert(tile.at("cell").get<std::string>());
        return names;
    }
};

class Stream : public testing::Test {
protected:
    void SetUp() override {
        const fs::path importer = fs::path(VOXSHEET_BINARY_DIR) / "voxsheet-import";
        if (!fs::exists(importer)) GTEST_SKIP() << "voxsheet-import is not built";
        fs::create_directories(folder_);
        engine::EngineOptions options;
        options.storeDir = folder_ / "store";
        options.uploadDir = folder_ / "uploads";
        options.roots = {folder_};
        options.importer = importer;
        try {
            engine_ = std::make_unique<engine::Engine>(options);
        } catch (const GpuError& error) {
            GTEST_SKIP() << error.what();
        }
        tiles_ = std::make_unique<TileService>(*engine_);
        hub_ = std::make_unique<StreamHub>(*engine_, *tiles_);
    }
    void TearDown() override {
        hub_.reset();
        tiles_.reset();
        engine_.reset();
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    /// Soft balls, each of another size.
    void openBalls(int count) {
        engine::ImportLayout layout;
        layout.columns = kColumns;
        std::vector<engine::ImportRequest> requests;
        for (int i = 0; i < count; ++i) {
            requests.emplace_back();
            requests.back().files = {ball(opened_ + i)};
        }
        if (opened_ > 0) layout.columns.reset();
        opened_ += count;
        engine_->importDatasets(requests, layout);
        ASSERT_TRUE(engine_->waitIdle(60));
    }

    [[nodiscard]] fs::path ball(int number) const {
        std::string voxels;
        for (int k = 0; k < kEdge; ++k)
            for (int j = 0; j < kEdge; ++j)
                for (int i = 0; i < kEdge; ++i) {
                    const double r = std::hypot(i - kEdge / 2, j - kEdge / 2, k - kEdge / 2) / kEdge;
                    voxels += static_cast<char>(255.0 * std::exp(-r * r * (8.0 + number)));
                }
        const fs::path file = folder_ / ("ball" + std::to_string(number) + ".nrrd");
        std::ofstream(file, std::ios::binary)
            << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 64 64 64\nencoding: raw\n\n"
            << voxels;
        return file;
    }

    [[nodiscard]] ClientView view(int cells, int tilePixels, double azimuth = 30.0) {
        ClientView view;
        view.id = ++viewId_;
        for (int i = 0; i < cells; ++i)
            view.tiles.push_back({{i % kColumns, i / kColumns}, glm::ivec2(tilePixels)});
        view.overrides.all["camera.azimuth"] = azimuth;
        return view;
    }

    /// Acknowledges all frames, as a page does, until rest.
    Received untilRest(const std::string& id, std::optional<ClientView> view = {}) {
        Received received;
        const std::uint64_t wanted = view ? view->id : viewId_;
        const std::uint64_t version = engine_->version();
        if (view) hub_->update(id, {std::nullopt, std::move(view)});
        for (int messages = 0; messages < 2000; ++messages) {
            const auto bytes = hub_->next(id);
            if (!bytes) break;
            const auto header = parseMessage(*bytes).header;
            const auto type = header.at("type").get<std::string>();
            if (type == "cell" && header.at("state") == "error") received.errors.push_back(header);
            if (type == "tile") {
                received.tiles.push_back(header);
                received.drawnPixels += header.at("width").get<double>() * header.at("height").get<double>();
            }
            if (header.value("frameEnd", false))
                hub_->update(id, {header.at("frame").get<std::uint64_t>(), std::nullopt});
            if (type == "rest" && header.at("view") == wanted && header.at("version") >= version)
                return received;
        }
        ADD_FAILURE() << "the stream did not come to rest";
        return received;
    }

    static void expectFinalLevels(const Received& received, int level) {
        for (const auto& tile : received.tiles)
            if (tile.at("final").get<bool>()) {
                EXPECT_EQ(tile.at("level"), level) << tile.dump();
            }
    }

    void choose(const LevelSettings& settings) { hub_->levels("Sheet1").setSettings(settings); }

    fs::path folder_ = fs::temp_directory_path() / ("voxsheet-stream-" + std::to_string(::getpid()));
    std::unique_ptr<engine::Engine> engine_;
    std::unique_ptr<TileService> tiles_;
    std::unique_ptr<StreamHub> hub_;
    std::uint64_t viewId_ = 0;
    int opened_ = 0;
};

TEST_F(Stream, OneDirtyCellOfTwentyFiveCostsAtMostAFifteenthOfTheSheet) {
    openBalls(25);
    const auto id = hub_->open("Sheet1");
    const auto whole = untilRest(id, view(25, 96));
    EXPECT_EQ(whole.cells().size(), 25U);
    engine_->apply(
        sheet::SetStyle{"Sheet1", sheet::Layer::ofCell({2, 2}), {{"transfer.map", std::string("grey")}}});
    const auto one = untilRest(id);
    EXPECT_EQ(one.cells(), std::set<std::string>{"C3"});
    EXPECT_GE(one.tiles.size(), 1U);
    EXPECT_LE(one.drawnPixels, 25.0 * 96 * 96 / 15.0);
}

TEST_F(Stream, ARestingCameraCostsNoRenderingAndNoBytes) {
    openBalls(4);
    const auto id = hub_->open("Sheet1");
    static_cast<void>(untilRest(id, view(4, 96)));
    const auto before = hub_->statistics();
    // The only thing that ever comes is the ping after 5 s of silence.
    const auto message = hub_->next(id);
    ASSERT_TRUE(message);
    EXPECT_EQ(parseMessage(*message).header.at("type"), "ping");
    const auto after = hub_->statistics();
    EXPECT_EQ(after.tiles, before.tiles);
    EXPECT_EQ(after.frames, before.frames);
    EXPECT_EQ(after.bytes, before.bytes);
    // The same view again, as a page sends it after a resize that changes nothing.
    EXPECT_TRUE(untilRest(id, view(4, 96)).tiles.empty());
}

TEST_F(Stream, AMovingSheetComesInOnePictureToPagesThatAskForIt) {
    openBalls(9);
    const auto id = hub_->open("Sheet1", {.atlas = true});
    static_cast<void>(untilRest(id, view(9, 96)));
    auto moving = view(9, 96, 50.0);
    moving.moving = true;
    hub_->update(id, {std::nullopt, moving});
    std::set<std::string> cells;
    for (bool ended = false; !ended;) {
        const auto bytes = hub_->next(id);
        ASSERT_TRUE(bytes);
        const auto message = parseMessage(*bytes);
        if (!message.header.contains("frameEnd")) continue;
        ended = message.header.at("frameEnd").get<bool>();
        ASSERT_EQ(message.header.at("type"), "tiles");
        EXPECT_EQ(message.header.at("format"), "jpeg");
        EXPECT_FALSE(message.payload.empty());
        std::uint64_t last = 0;
        for (const auto& tile : message.header.at("tiles")) {
            EXPECT_TRUE(cells.insert(tile.at("cell").get<std::string>()).second) << tile.dump();
            EXPECT_GT(tile.at("seq").get<std::uint64_t>(), last);
            last = tile.at("seq").get<std::uint64_t>();
            EXPECT_FALSE(tile.at("final").get<bool>());
            EXPECT_EQ(tile.at("x").get<int>() % 16, 0);
        }
    }
    EXPECT_EQ(cells.size(), 9U);
    // At rest each cell has a lossless picture of its own, that others can be given.
    const auto rest = untilRest(id, view(9, 96, 50.0));
    EXPECT_EQ(rest.cells().size(), 9U);
    for (const auto& tile : rest.tiles)
        EXPECT_EQ(tile.at("format"), "png");
}

TEST_F(Stream, AVolumeThatCannotBeReadIsToldAndTheOthersAreDrawn) {
    openBalls(3);
    fs::path samples;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "store"))
        if (entry.path().filename() == "f0_s0.raw") samples = entry.path();
    ASSERT_FALSE(samples.empty());
    const auto whole = folder_ / "whole.raw";
    fs::copy_file(samples, whole);
    const auto id = hub_->open("Sheet1");
    EXPECT_EQ(untilRest(id, view(3, 16)).cells().size(), 3U); // from coarse levels
    LevelSettings finest;
    finest.policy = LevelPolicy::Off;
    choose(finest);
    fs::resize_file(samples, 0);
    auto moving = view(3, 96);
    moving.moving = true;
    hub_->update(id, {std::nullopt, moving});
    const auto first = untilRest(id, view(3, 96, 50.0)); // it ends: what fails is not tried for ever
    ASSERT_FALSE(first.errors.empty());
    const auto failed = first.errors.front().at("cell").get<std::string>();
    EXPECT_EQ(first.errors.front().at("code"), "#GPU!");
    for (const auto& error : first.errors)
        EXPECT_EQ(error.at("cell"), failed);
    std::set<std::string> drawn;
    for (const auto& tile : first.tiles)
        if (tile.at("final").get<bool>()) drawn.insert(tile.at("cell").get<std::string>());
    EXPECT_EQ(drawn.size(), 2U);
    EXPECT_EQ(drawn.count(failed), 0U);
    // Any other view tries again.
    fs::copy_file(whole, samples, fs::copy_options::overwrite_existing);
    const auto second = untilRest(id, view(3, 96, 70.0));
    EXPECT_EQ(second.cells().size(), 3U);
    EXPECT_TRUE(second.errors.empty());
}

TEST_F(Stream, OnlyVisibleCellsAreDrawn) {
    openBalls(10);
    const auto id = hub_->open("Sheet1");
    EXPECT_EQ(untilRest(id, view(3, 64)).cells(), (std::set<std::string>{"A1", "B1", "C1"}));
    // Scrolled on: those that are known to be on the page already are not sent again.
    EXPECT_EQ(untilRest(id, view(5, 64)).cells(), (std::set<std::string>{"D1", "E1"}));
}

TEST_F(Stream, ACellIsAsFineAsItsPictureCanShow) {
    openBalls(1);
    const auto id = hub_->open("Sheet1");
    // At the default distance a 64^3 cube's voxels are about 2.5 pixels in a picture of 256, 0.6 in one
    // of 64.
    expectFinalLevels(untilRest(id, view(1, 256)), 0);
    expectFinalLevels(untilRest(id, view(1, 40)), 1);
    expectFinalLevels(untilRest(id, view(1, 20)), 2);
    LevelSettings off;
    off.policy = LevelPolicy::Off;
    choose(off);
    expectFinalLevels(untilRest(id, view(1, 21)), 0);
}

TEST_F(Stream, TheCountRuleLowersAllCellsAndGoesBackWithFewer) {
    openBalls(5);
    LevelSettings settings;
    settings.policy = LevelPolicy::Count;
    settings.datasets = 3;
    choose(settings);
    const auto id = hub_->open("Sheet1");
    expectFinalLevels(untilRest(id, view(3, 200)), 0);
    const auto five = untilRest(id, view(5, 200));
    EXPECT_EQ(five.cells().size(), 5U); // the three that were final are drawn again, coarser
    EXPECT_EQ(five.tiles.back().at("level"), 1);
    const auto timings = hub_->levels("Sheet1").timings();
    EXPECT_EQ(timings.level, 1);
    EXPECT_EQ(timings.n, 5);
    EXPECT_NE(timings.reason.find("5 datasets"), std::string::npos) << timings.reason;
    const auto two = untilRest(id, view(2, 200));
    EXPECT_EQ(two.tiles.back().at("level"), 0);
}

TEST_F(Stream, ThePolicyFollowsTheWorkbookAndItsUndo) {
    openBalls(2);
    const auto id = hub_->open("Sheet1");
    expectFinalLevels(untilRest(id, view(2, 200)), 0);
    LevelSettings one;
    one.policy = LevelPolicy::Count;
    one.datasets = 1;
    engine_->apply(sheet::SetLevels{"Sheet1", one});
    EXPECT_EQ(untilRest(id).tiles.back().at("level"), 1); // no new view: the edit alone brings it about
    EXPECT_TRUE(engine_->undo());
    EXPECT_EQ(untilRest(id).tiles.back().at("level"), 0);
    EXPECT_EQ(hub_->levels("Sheet1").settings(), LevelSettings{});
    // A sheet that is first asked for after the edit has it from the workbook as well.
    engine_->apply(sheet::AddSheet{"Second"});
    engine_->apply(sheet::SetLevels{"Second", one});
    EXPECT_EQ(hub_->levels("Second").settings(), one);
}

TEST_F(Stream, AFrameTimeThatCannotBeMetLowersAllCellsToTheCoarsest) {
    openBalls(2);
    LevelSettings settings;
    settings.policy = LevelPolicy::Time;
    settings.frameMs = 1e-3; // no machine draws two volumes in a microsecond
    choose(settings);
    const auto id = hub_->open("Sheet1");
    static_cast<void>(untilRest(id, view(2, 128)));
    const auto received = untilRest(id, view(2, 128, 50.0));
    EXPECT_EQ(received.tiles.back().at("level"), 2);
    EXPECT_TRUE(untilRest(id, view(2, 128, 50.0)).tiles.empty()); // it does not go on and on
}

TEST_F(Stream, PinnedLevelsHoldForThePageAndNotForExports) {
    openBalls(2);
    engine_->apply(sheet::SetStyle{"Sheet1", sheet::Layer::ofCell({1, 0}), {{"level", std::int64_t{2}}}});
    const auto id = hub_->open("Sheet1");
    const auto received = untilRest(id, view(2, 256));
    for (const auto& tile : received.tiles) {
        const bool pinned = tile.at("cell") == "B1";
        EXPECT_EQ(tile.contains("pinned"), pinned);
        if (tile.at("final").get<bool>()) {
            EXPECT_EQ(tile.at("level"), pinned ? 2 : 0);
        }
    }
    CellImageRequest request;
    request.sheet = "Sheet1";
    request.cell = {1, 0};
    request.quality.sizePixels = {64, 64};
    EXPECT_EQ(tiles_->cellImage(request)->level, 0);
    request.view.request["level"] = std::int64_t{1};
    EXPECT_EQ(tiles_->cellImage(request)->level, 1);
    engine::SheetImageRequest sheet;
    sheet.sizePixels = {300, 200};
    EXPECT_EQ(tiles_->sheetImage(sheet, {})->level, 0);
    sheet.view.request["level"] = std::int64_t{1};
    EXPECT_EQ(tiles_->sheetImage(sheet, {})->level, 1);
}

TEST_F(Stream, RedrawsGiveTheTimeOfNAndPartialOnesAWiderInterval) {
    openBalls(3);
    const auto id = hub_->open("Sheet1");
    static_cast<void>(untilRest(id, view(2, 96)));
    EXPECT_TRUE(hub_->levels("Sheet1").timings().points.empty()); // the first pictures wait for shaders
    static_cast<void>(untilRest(id, view(2, 96, 45.0)));
    static_cast<void>(untilRest(id, view(3, 96, 45.0))); // one cell more: the other two are as they were
    auto points = hub_->levels("Sheet1").timings().points;
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].n, 2);
    EXPECT_FALSE(points[0].partly);
    EXPECT_EQ(points[1].n, 3);
    EXPECT_TRUE(points[1].partly);
    EXPECT_GT(points[1].ms.value, points[0].ms.value) << "what the two took, and the third";
    EXPECT_GT(points[1].ms.high - points[1].ms.low, 0.0);
    EXPECT_TRUE(untilRest(id, view(3, 96, 45.0)).tiles.empty()) << "and it is at rest";
    static_cast<void>(untilRest(id, view(3, 96, 60.0)));
    points = hub_->levels("Sheet1").timings().points;
    ASSERT_EQ(points.size(), 2U);
    EXPECT_FALSE(points[1].partly);
    EXPECT_GT(points[1].ms.value, 0.0);
    EXPECT_GT(points[1].residentBytes, 0U);
}

TEST_F(Stream, TimesOnRequestGiveACurveWithIntervals) {
    openBalls(4);
    auto& levels = hub_->levels("Sheet1");
    MeasureRequest request;
    request.repeats = 3;
    const auto result = measureTimeN(*engine_, levels, "Sheet1", view(4, 64), request, {});
    EXPECT_EQ(result.n, 4);
    EXPECT_EQ(result.frames, 12);
    const auto points = levels.timings().points;
    ASSERT_EQ(points.size(), 4U);
    for (const auto& point : points) {
        EXPECT_EQ(point.ms.count, 3);
        EXPECT_LE(point.ms.low, point.ms.value);
        EXPECT_LE(point.ms.value, point.ms.high);
    }
    request.repeats = 1;
    EXPECT_THROW((void)measureTimeN(*engine_, levels, "Sheet1", view(4, 64), request, {}), InvalidInput);
    EXPECT_THROW((void)measureTimeN(*engine_, levels, "Sheet1", ClientView{}, MeasureRequest{}, {}),
                 Conflict);
}

} // namespace
} // namespace voxsheet::stream
