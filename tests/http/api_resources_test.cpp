// The resources of the real program: what a script may rely on.
#include "raw_client.h"
#include "shared_program.h"
#include "stream_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <list>
#include <random>
#include <string>
#include <thread>
#include <vector>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";

struct ApiResources : SharedProgram<ApiResources> {
    static constexpr int datasets = 3;
    static std::vector<std::string> arguments() { return {"--columns", "2"}; }
};

TEST_F(ApiResources, Information) {
    const auto info = getJson("/api/v1");
    EXPECT_EQ(info.at("name"), "Voxsheet");
    EXPECT_FALSE(info.at("device").at("renderer").get<std::string>().empty());
    EXPECT_FALSE(info.at("device").at("reason").get<std::string>().empty());
    EXPECT_GT(getJson("/api/v1/keys").at("keys").size(), 15U);
    EXPECT_GE(getJson("/api/v1/colourmaps").at("maps").size(), 12U);
    EXPECT_EQ(getJson("/api/v1/openapi.json").at("openapi"), "3.1.0");
    const auto metrics = program_->get("/metrics");
    EXPECT_NE(metrics.body.find("voxsheet_datasets{state=\"ready\"} 3"), std::string::npos) << metrics.body;
}

TEST_F(ApiResources, DatasetsAndHistogram) {
    const auto list = getJson("/api/v1/datasets").at("datasets");
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[0].at("state"), "ready");
    EXPECT_EQ(list[0].at("dims"), json::array({12, 10, 8}));
    const auto name = list[0].at("name").get<std::string>();
    EXPECT_EQ(getJson("/api/v1/datasets/" + name).at("name"), name);
    const auto histogram = getJson("/api/v1/datasets/" + name + "/histogram");
    std::uint64_t total = 0;
    for (const auto& count : histogram.at("counts"))
        total += count.get<std::uint64_t>();
    EXPECT_EQ(total, 960U);
    EXPECT_EQ(program_->get("/api/v1/datasets/absent").status, 404);
    EXPECT_EQ(program_->get("/api/v1/datasets/" + name + "/histogram?step=99").status, 404);
}

TEST_F(ApiResources, StateListsCellsWithStyles) {
    const auto state = getJson("/api/v1/state");
    const auto& sheet = state.at("sheets").at(0);
    EXPECT_EQ(sheet.at("columns"), 2);
    EXPECT_EQ(sheet.at("rows"), 2);
    ASSERT_EQ(sheet.at("cells").size(), 4U);
    EXPECT_EQ(sheet.at("cells").at(0).at("cell"), "A1");
    EXPECT_EQ(sheet.at("cells").at(0).at("state"), "ok");
    EXPECT_EQ(sheet.at("cells").at(0).at("box").at("edges").size(), 3U);
    EXPECT_EQ(sheet.at("cells").at(3).at("state"), "empty");
    EXPECT_TRUE(sheet.at("cells").at(3).at("box").is_null());
    EXPECT_EQ(sheet.at("cells").at(0).at("style").at("camera.azimuth").at("origin"), "default");
}

TEST_F(ApiResources, StateOfOwnStylesSaysTheSameInFewerBytes) {
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/cells/B1", R"({"camera.azimuth": 77})").status, 200);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", R"({"camera.fov": 25})").status, 200);
    const auto all = program_->get("/api/v1/state");
    const auto own = program_->get("/api/v1/state?styles=own");
    EXPECT_LT(2 * own.body.size(), all.body.size());
    const auto sheet = own.json().at("sheets").at(0);
    const auto whole = all.json().at("sheets").at(0);
    for (std::size_t i = 0; i < whole.at("cells").size(); ++i) {
        auto style = sheet.at("style");
        style.update(sheet.at("cells").at(i).at("style"));
        EXPECT_EQ(style, whole.at("cells").at(i).at("style")) << i;
    }
    EXPECT_EQ(sheet.at("cells").at(1).at("style").size(), 1U);
    EXPECT_EQ(program_->get("/api/v1/state?styles=none").status, 400);
    static_cast<void>(program_->ask("POST", "/api/v1/undo"));
    static_cast<void>(program_->ask("POST", "/api/v1/undo"));
}

TEST_F(ApiResources, StylesInheritHideAndReset) {
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/cells/B1", R"({"camera.azimuth": 77})").status, 200);
    const auto edit = program_->ask("PATCH", kSheet + "/style?gesture=g1", R"({"camera.azimuth": 12})");
    ASSERT_EQ(edit.status, 200) << edit.body;
    EXPECT_EQ(edit.json().at("hidden").at(0),
              (json{{"cell", "B1"}, {"key", "camera.azimuth"}, {"by", "cell"}}));
    static_cast<void>(program_->ask("PATCH", kSheet + "/style?gesture=g1", R"({"camera.azimuth": 13})"));
    EXPECT_EQ(getJson(kSheet + "/style").at("camera.azimuth"), 13);
    const auto cell = getJson(kSheet + "/cells/A1");
    EXPECT_EQ(cell.at("resolved").at("camera.azimuth").at("origin"), "sheet");
    EXPECT_EQ(getJson(kSheet + "/cells/B1").at("camera.azimuth"), 77);
    static_cast<void>(program_->ask("POST", "/api/v1/undo")); // both edits of the gesture
    EXPECT_FALSE(getJson(kSheet + "/style").contains("camera.azimuth"));
    EXPECT_EQ(
        program_->ask("POST", kSheet + "/clear-overrides", R"({"keys": ["camera.azimuth"], "cells": ["B1"]})")
            .status,
        200);
    EXPECT_FALSE(getJson(kSheet + "/cells/B1").contains("camera.azimuth"));
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/columns/B/style", R"({"camera.roll": 5})").status, 200);
    EXPECT_EQ(getJson(kSheet + "/cells/B2").at("resolved").at("camera.roll").at("origin"), "column");
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/columns/B/style", R"({"camera.roll": null})").status, 200);
}

struct BadRequest {
    const char* method;
    std::string target;
    std::string body;
    int status;
    const char* field;
};

TEST_F(ApiResources, ProblemsNameTheField) {
    const std::vector<BadRequest> cases{
        {"PATCH", kSheet + "/style", R"({"camera.azimut": 1})", 400, "camera.azimut"},
        {"PATCH", kSheet + "/style", R"({"camera.fov": 1e9})", 400, "camera.fov"},
        {"PATCH", kSheet + "/style", R"({"camera.fov": "wide"})", 400, "camera.fov"},
        {"GET", kSheet + "/cells/A1/image.png?width=0", "", 400, "width"},
        {"GET", kSheet + "/cells/A1/image.png?camera.fov=abc", "", 400, "camera.fov"},
        {"GET", kSheet + "/cells/A1/image.png?nonsense=1", "", 400, "nonsense"},
        {"GET", "/api/v1/datasets?x=1", "", 400, "x"},
        {"GET", kSheet + "/probe?x=1&y=2", "", 400, "z"},
        {"POST", "/api/v1/datasets", R"({"files": "a"})", 400, "files"},
        {"POST", "/api/v1/datasets", R"({"files": ["a"], "other": 1})", 400, "other"},
        {"PATCH", kSheet, R"({"columns": 0})", 400, "columns"},
        {"PATCH", kSheet + "/resolution", R"({"policy": "steep"})", 400, "policy"},
        {"PATCH", kSheet + "/resolution", R"({"policy": 3})", 400, "policy"},
        {"PATCH", kSheet + "/resolution", R"({"policy": null, "frame_ms": 5})", 400, "policy"},
        {"PATCH", kSheet + "/resolution", R"({"frame_ms": 0})", 400, "frame_ms"},
        {"PATCH", kSheet + "/resolution", R"({"datasets": 0})", 400, "datasets"},
        {"PATCH", kSheet + "/resolution", R"({"bytes": 1e30})", 400, "bytes"},
        {"PATCH", kSheet + "/resolution", R"({"level": 1})", 400, "level"},
        {"POST", "/api/v1/streams/none", R"({"ack": -1})", 400, "ack"},
    };
    for (const auto& bad : cases) {
        const auto answer = program_->ask(bad.method, bad.target, bad.body);
        EXPECT_EQ(answer.status, bad.status) << bad.target << answer.body;
        EXPECT_EQ(answer.field("Content-Type"), "application/problem+json") << bad.target;
        const auto problem = answer.json();
        EXPECT_EQ(problem.value("field", ""), bad.field) << bad.target << answer.body;
        EXPECT_EQ(problem.value("status", 0), bad.status);
        EXPECT_FALSE(problem.value("detail", "").empty());
    }
    for (const auto* target :
         {"/api/v1/sheets/Absent/style", "/api/v1/sheets/Sheet1/cells/Z99", "/api/v1/streams/none/x"})
        EXPECT_EQ(program_->get(target).status, 404) << target;
    EXPECT_EQ(program_->get(kSheet + "/cells/A1/image.gif").status, 404);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", std::string(900000, '[')).status, 400);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", "{}", "Content-Type: image/png\r\n").status, 415);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", std::string(2U << 20U, ' ')).status, 413);
}

TEST_F(ApiResources, PicturesWithTagsAndOverrides) {
    const auto image = program_->get(kSheet + "/cells/A1/image.png?width=64&height=48");
    ASSERT_EQ(image.status, 200) << image.body;
    EXPECT_EQ(image.body.substr(1, 3), "PNG");
    EXPECT_EQ(image.field("Content-Type"), "image/png");
    EXPECT_EQ(image.field("X-Voxsheet-Level"), "0");
    EXPECT_EQ(image.field("X-Voxsheet-Final"), "true");
    EXPECT_FALSE(image.field("X-Voxsheet-Render-Ms").empty());
    const auto tag = image.field("ETag");
    const auto again = program_->ask("GET", kSheet + "/cells/A1/image.png?width=64&height=48", "",
                                     "If-None-Match: \"x\", " + tag + "\r\n");
    EXPECT_EQ(again.status, 304);
    EXPECT_TRUE(again.body.empty());
    const auto turned = program_->get(kSheet + "/cells/A1/image.png?width=64&height=48&camera.azimuth=200");
    EXPECT_EQ(turned.status, 200);
    EXPECT_NE(turned.field("ETag"), tag);
    EXPECT_NE(turned.body, image.body);
    EXPECT_EQ(program_->get(kSheet + "/cells/A1/image.jpg?width=64&height=48").body.substr(0, 2), "\xFF\xD8");
    EXPECT_EQ(program_->get(kSheet + "/cells/A1/image.webp?width=64&height=48").body.substr(8, 4), "WEBP");
    EXPECT_EQ(program_->get(kSheet + "/image.png?width=400&height=300").body.substr(1, 3), "PNG");
    EXPECT_EQ(program_->get(kSheet + "/image.png?width=400&height=300&range=A1:B1&title=Two").status, 200);
    EXPECT_EQ(program_->get(kSheet + "/cells/B2/image.png").status, 404); // empty
}

TEST_F(ApiResources, AClipObjectOfDataIsWaitedFor) {
    const std::string url = kSheet + "/cells/A1/image.png?width=64&height=48&clip.shape=B1%20%3E%2040";
    auto image = program_->get(url);
    for (int tries = 0; image.status == 409 && tries < 600; ++tries) {
        EXPECT_NE(image.body.find("B1 > 40"), std::string::npos) << image.body;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        image = program_->get(url);
    }
    EXPECT_EQ(image.status, 200) << image.body;
    const auto broken =
        program_->get(kSheet + "/cells/A1/image.png?width=64&height=48&clip.shape=C9%20%3E%201");
    EXPECT_EQ(broken.status, 400);
    EXPECT_NE(broken.body.find("clip.shape"), std::string::npos) << broken.body;
}

TEST_F(ApiResources, TwoCellsFusedInOnePicture) {
    const auto url = kSheet + "/cells/A1/image.png?width=64&height=48";
    const auto alone = program_->get(url);
    ASSERT_EQ(alone.status, 200) << alone.body;
    const auto fused = program_->get(url + "&layers=B1&layers.weights=1,0.5");
    ASSERT_EQ(fused.status, 200) << fused.body;
    EXPECT_NE(fused.body, alone.body);
    EXPECT_EQ(program_->get(url + "&layers=A1").body, alone.body) << "it is there already";
    const auto bar = getJson(kSheet + "/cells/A1/colourbar?layers=B1&layers.weights=1,0.5");
    EXPECT_EQ(bar.at("layers").at(0).at("name"), "B1");
    EXPECT_EQ(bar.at("layers").at(0).at("weight"), 0.5);
    const auto probed =
        getJson(kSheet + "/probe?cell=A1&px=32&py=24&width=64&height=48&layers=B1").at("values").at(0);
    EXPECT_EQ(probed.at("layers").at(0).at("name"), "B1");
    EXPECT_TRUE(probed.at("layers").at(0).contains("value"));
    for (const auto* query : {"&layers=C9", "&layers=B1&technique=slices", "&layers=B1&layers.weights=2"}) {
        const auto refused = program_->get(url + query);
        EXPECT_EQ(refused.status, 400) << query;
        EXPECT_NE(refused.body.find("layers"), std::string::npos) << refused.body;
    }
}

TEST_F(ApiResources, ProbeReadsSourceValues) {
    const auto probe = getJson(kSheet + "/probe?x=3&y=4&z=5");
    ASSERT_EQ(probe.at("values").size(), 3U);
    EXPECT_EQ(probe.at("values").at(0).at("cell"), "A1");
    EXPECT_DOUBLE_EQ(probe.at("values").at(0).at("value").get<double>(), 3 + 40 + 15);
    EXPECT_DOUBLE_EQ(probe.at("values").at(1).at("value").get<double>(), 3 + 40 + 15 + 1);
    const auto outside = getJson(kSheet + "/probe?x=-500&y=4&z=5");
    EXPECT_TRUE(outside.at("values").at(0).at("value").is_null());
    const auto pixel = getJson(kSheet + "/probe?cell=A1&px=32&py=24&width=64&height=48");
    EXPECT_EQ(pixel.at("values").size(), 3U);
    const auto own = [](const json& answer) { return answer.at("values").at(0); };
    EXPECT_TRUE(own(probe).at("hit").is_null()) << "a point of the world is no pixel";
    EXPECT_TRUE(own(probe).at("isovalue").is_null());
    EXPECT_TRUE(own(pixel).at("hit") == "sample" || own(pixel).at("hit") == "middle") << pixel.dump();
    EXPECT_TRUE(pixel.at("values").at(1).at("hit").is_null());
    const auto surface = getJson(kSheet + "/probe?cell=A1&px=32&py=24&width=64&height=48&technique=isosurface"
                                          "&isovalue=40");
    EXPECT_EQ(own(surface).at("hit"), "isosurface");
    EXPECT_EQ(own(surface).at("isovalue"), 40);
    EXPECT_NEAR(own(surface).at("interpolated").get<double>(), 40, 1e-3);
    const auto cut = getJson(kSheet + "/probe?cell=A1&px=32&py=24&width=64&height=48&technique=surface"
                                      "&clip.shape=sphere&clip.mode=probe");
    EXPECT_EQ(own(cut).at("hit"), "face");
    const auto bar = getJson(kSheet + "/cells/A1/colourbar");
    EXPECT_EQ(bar.at("stops").size(), 64U);
    EXPECT_TRUE(bar.at("isovalues").empty());
    const auto marked = getJson(kSheet + "/cells/A1/colourbar?technique=isosurface&isovalue=40");
    EXPECT_EQ(marked.at("isovalues").at(0).at("value"), 40);
    EXPECT_GE(getJson(kSheet + "/timings").at("n").get<int>(), 3);
}

TEST_F(ApiResources, FilesBrowseTheRoot) {
    const auto roots = getJson("/api/v1/files");
    EXPECT_EQ(roots.at("entries").at(0).at("path"), program_->folder().string());
    const auto listing = getJson("/api/v1/files?path=" + program_->folder().string() + "&glob=a*");
    ASSERT_EQ(listing.at("entries").size(), 1U);
    EXPECT_EQ(listing.at("entries").at(0).at("format"), "nrrd");
    const auto preview = getJson("/api/v1/files/preview?path=" + program_->folder().string() + "/a.nrrd");
    EXPECT_EQ(preview.at("dims"), json::array({12, 10, 8}));
}

TEST_F(ApiResources, UploadImportFailAndRemove) {
    const auto good = program_->ask("PUT", "/api/v1/datasets/up/content?filename=up.nrrd", sampleNrrd(9));
    ASSERT_EQ(good.status, 202) << good.body;
    const auto bad = program_->ask("PUT", "/api/v1/datasets/broken/content?filename=..%2F..%2Fbroken.nrrd",
                                   sampleNrrd(9).substr(0, 200));
    ASSERT_EQ(bad.status, 202) << bad.body;
    ASSERT_TRUE(program_->waitForImports());
    EXPECT_EQ(getJson("/api/v1/datasets/" + good.json().at("name").get<std::string>()).at("state"), "ready");
    const auto failed = getJson("/api/v1/datasets/" + bad.json().at("name").get<std::string>());
    EXPECT_EQ(failed.at("state"), "failed");
    EXPECT_FALSE(failed.at("error").at("message").get<std::string>().empty());
    for (const auto* name : {"up", "broken"})
        EXPECT_EQ(program_->ask("DELETE", std::string("/api/v1/datasets/") + name).status, 204);
    EXPECT_EQ(program_->get("/api/v1/datasets/up").status, 404);
}

TEST_F(ApiResources, FormulaCell) {
    ASSERT_EQ(
        program_->ask("PATCH", kSheet + "/cells/B2", R"({"source": "=B1-A1", "title": "difference"})").status,
        200);
    json cell;
    for (int i = 0; i < 100; ++i) {
        cell = getJson(kSheet + "/cells/B2");
        if (cell.at("state") != "importing") break;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_EQ(cell.at("state"), "ok") << cell.dump();
    EXPECT_EQ(cell.at("source").at("formula"), "=B1-A1");
    EXPECT_EQ(cell.at("box"), getJson(kSheet + "/cells/B1").at("box"));
    EXPECT_EQ(program_->get(kSheet + "/cells/B2/image.png?width=32&height=32").status, 200);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/cells/B2", R"({"source": null, "title": null})").status, 200);
    EXPECT_EQ(getJson(kSheet + "/cells/B2").at("state"), "empty");
}

TEST_F(ApiResources, WorkbookRoundTripAndLostEdits) {
    const auto answer = program_->get("/api/v1/workbook");
    const auto tag = answer.field("ETag");
    EXPECT_EQ(program_->ask("PUT", "/api/v1/workbook", answer.body, "If-Match: \"0\"\r\n").status, 412);
    EXPECT_EQ(program_->ask("PUT", "/api/v1/workbook", answer.body, "If-Match: " + tag + "\r\n").status, 200);
    EXPECT_EQ(getJson("/api/v1/workbook"), answer.json());
    EXPECT_EQ(program_->ask("PUT", "/api/v1/workbook", R"({"voxsheet": 1, "sheets": [], "typo": 1})").status,
              400);
    const auto target = program_->folder() / "saved.json";
    EXPECT_EQ(program_->ask("POST", "/api/v1/workbook/save", json{{"path", target.string()}}.dump()).status,
              200);
    EXPECT_EQ(json::parse(std::ifstream(target)).at("voxsheet"), 1);
    ASSERT_TRUE(program_->waitForImports());
    for (const auto& dataset : getJson("/api/v1/datasets").at("datasets"))
        EXPECT_EQ(dataset.at("state"), "ready") << dataset.dump();
}

TEST_F(ApiResources, LevelPolicyBelongsToTheWorkbook) {
    const auto inUse = [] { return getJson(kSheet + "/resolution"); };
    const auto inWorkbook = [] {
        return getJson("/api/v1/workbook").at("sheets").at(0).value("levels", json());
    };
    EXPECT_EQ(inUse().at("policy"), "focus");
    EXPECT_EQ(inUse().at("from"), "server");
    EXPECT_TRUE(inWorkbook().is_null());

    const auto set = program_->ask("PATCH", kSheet + "/resolution", R"({"policy": "time", "frame_ms": 250})");
    ASSERT_EQ(set.status, 200) << set.body;
    EXPECT_EQ(set.json().at("from"), "workbook");
    EXPECT_EQ(inWorkbook().at("policy"), "time");
    EXPECT_EQ(inWorkbook().at("frame_ms"), 250);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/resolution", R"({"policy": "slope"})").status, 200);
    EXPECT_EQ(inUse().at("frame_ms"), 250) << "members that are left out stay";

    const auto document = program_->get("/api/v1/workbook").body; // as a file would keep it
    EXPECT_EQ(program_->ask("POST", "/api/v1/undo").status, 200);
    EXPECT_EQ(inUse().at("policy"), "time");
    EXPECT_EQ(program_->ask("POST", "/api/v1/undo").status, 200);
    EXPECT_EQ(inUse().at("policy"), "focus");
    EXPECT_EQ(inUse().at("from"), "server");
    EXPECT_EQ(program_->ask("PUT", "/api/v1/workbook", document).status, 200);
    EXPECT_EQ(inUse().at("policy"), "slope") << "a workbook that is opened brings its policy";
    EXPECT_EQ(getJson(kSheet + "/timings").at("policy"), "slope");

    EXPECT_EQ(program_->ask("PATCH", kSheet + "/resolution", R"({"policy": null})").json().at("from"),
              "server");
    EXPECT_EQ(inUse().at("policy"), "focus");
    EXPECT_TRUE(inWorkbook().is_null());
    ASSERT_TRUE(program_->waitForImports());
}

TEST_F(ApiResources, StreamGivesTilesAndTakesViews) {
    StreamReader stream(*program_, kSheet + "/stream?width=200&height=160&dpr=1");
    ASSERT_EQ(stream.status(), 200);
    const auto hello = stream.next("hello").header;
    ASSERT_TRUE(hello.is_object());
    const auto path = "/api/v1/streams/" + hello.at("stream").get<std::string>();
    const auto first = stream.next("tile");
    ASSERT_GT(first.payload.size(), 50U);
    std::uint64_t frame = first.header.at("frame").get<std::uint64_t>();
    const json view{{"id", 1},
                    {"moving", false},
                    {"tiles", {{{"cell", "A1"}, {"width", 60}, {"height", 50}}}},
                    {"style", {{"camera.azimuth", 123}}}};
    ASSERT_EQ(program_->ask("POST", path, json{{"ack", frame}, {"view", view}}.dump()).status, 204);
    bool final = false;
    for (int i = 0; i < 50 && !final; ++i) {
        const auto tile = stream.next("tile");
        ASSERT_TRUE(tile.header.is_object());
        frame = tile.header.at("frame").get<std::uint64_t>();
        final =
            tile.header.at("view") == 1 && tile.header.at("final") == true && tile.header.at("cell") == "A1";
        static_cast<void>(program_->ask("POST", path, json{{"ack", frame}}.dump()));
    }
    EXPECT_TRUE(final);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", R"({"camera.elevation": 33})").status, 200);
    EXPECT_TRUE(stream.next("workbook").header.is_object());
    EXPECT_EQ(program_
                  ->get(kSheet + "/probe?cell=A1&px=30&py=25&width=60&height=50&stream=" +
                        hello.at("stream").get<std::string>())
                  .status,
              200);
    EXPECT_EQ(program_->ask("DELETE", path).status, 204);
    EXPECT_EQ(program_->ask("POST", path, R"({"ack": 1})").status, 404);
}

TEST_F(ApiResources, MotionJpegBeginsWithAPicture) {
    RawClient client(program_->port());
    client.send("GET " + kSheet +
                "/stream.mjpeg?width=160&height=120 HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
                program_->token() + "\r\n\r\n");
    std::string bytes;
    for (int i = 0; i < 50 && bytes.find("\xFF\xD8") == std::string::npos; ++i)
        bytes += client.readAll(0.2);
    EXPECT_EQ(fieldOfResponse(bytes, "Content-Type"), "multipart/x-mixed-replace; boundary=voxsheet-frame");
    EXPECT_NE(bytes.find("Content-Type: image/jpeg"), std::string::npos);
    EXPECT_NE(bytes.find("\xFF\xD8"), std::string::npos);
}

TEST_F(ApiResources, NoRandomRequestIsAFaultOfTheProgram) {
    std::mt19937 random(20240607);
    const auto document = getJson("/api/v1/openapi.json");
    std::vector<std::pair<std::string, std::string>> routes;
    for (const auto& [pattern, methods] : document.at("paths").items())
        for (const auto& [method, operation] : methods.items())
            if (pattern.find("stream") == std::string::npos &&
                pattern.find("workbook/save") == std::string::npos)
                routes.emplace_back(method, pattern);
    const std::vector<std::string> words{
        "A1",       "Sheet1", "-1", "0",    "1e999", "%00", "%2F..%2F", "nan",
        "\xC3\xA9", "=A1",    "{}", "null", "png",   "a",   "AAAA",     "99999999999999999999"};
    const std::vector<std::string> bodies{"",
                                          "{}",
                                          "[]",
                                          "null",
                                          "{\"a\":",
                                          "\"x\"",
                                          "1e999",
                                          "{\"source\": 5}",
                                          "{\"source\": \"=A1+\"}",
                                          "{\"columns\": -5}",
                                          "{\"files\": [1]}",
                                          "{\"keys\": []}",
                                          "{\"camera.azimuth\": [1]}",
                                          "\xFF\xFE",
                                          "{\"cells\": {\"A1\": 5}}"};
    const auto pick = [&](const auto& list) { return list[random() % list.size()]; };
    for (int i = 0; i < 300; ++i) {
        auto [method, target] = pick(routes);
        for (auto open = target.find('{'); open != std::string::npos; open = target.find('{')) {
            auto word = pick(words);
            if (word == "{}") word = "Sheet1";
            target.replace(open, target.find('}') - open + 1, word);
        }
        if (random() % 2 == 0) target += "?" + pick(words) + "=" + pick(words);
        for (auto& c : method)
            c = static_cast<char>(c - 32);
        const auto answer = program_->ask(method, target, method == "GET" ? "" : pick(bodies));
        EXPECT_NE(answer.status / 100, 5) << method << ' ' << target << ' ' << answer.body;
    }
    EXPECT_EQ(program_->get("/readyz").status, 200);
}

/// An NRRD file of dims 12x10x8 whose values lie the other way round than sampleNrrd's.
std::string reversedNrrd() {
    std::string file = sampleNrrd(0);
    const auto voxels = file.begin() + static_cast<std::ptrdiff_t>(file.size() - 12 * 10 * 8);
    std::reverse(voxels, file.end());
    return file;
}

TEST(ApiReimport, AFileThatChangedGivesItsNewPicture) {
    ServedProgram program(1);
    ASSERT_TRUE(program.waitForImports());
    const auto file = program.folder() / "a.nrrd";
    const auto name = program.get("/api/v1/datasets").json().at("datasets").at(0).at("name");
    const auto picture = [&](const std::string& fields = {}) {
        return program.ask("GET", kSheet + "/cells/A1/image.png?width=64&height=48", {}, fields);
    };
    const auto openAgain = [&](const std::string& contents) {
        std::ofstream(file, std::ios::binary) << contents;
        const auto answer =
            program.ask("POST", "/api/v1/datasets", json{{"files", {file.string()}}, {"name", name}}.dump());
        ASSERT_EQ(answer.status, 202) << answer.body;
        ASSERT_EQ(answer.json().at("datasets").at(0), name) << answer.body;
        ASSERT_TRUE(program.waitForImports());
    };
    const auto first = picture();
    ASSERT_EQ(first.status, 200) << first.body;
    openAgain(reversedNrrd()); // of the same size
    const auto second = picture("If-None-Match: " + first.field("ETag") + "\r\n");
    ASSERT_EQ(second.status, 200) << second.body;
    EXPECT_TRUE(second.body != first.body);
    const auto probe = program.get(kSheet + "/probe?x=0&y=0&z=0").json();
    EXPECT_EQ(probe.at("values").at(0).at("value"), 11 + 90 + 21);
    openAgain(sampleNrrd(0));
    const auto third = picture();
    ASSERT_EQ(third.status, 200) << third.body;
    EXPECT_TRUE(third.body == first.body);
    EXPECT_EQ(program.get("/api/v1/datasets").json().at("datasets").size(), 1U);
    // Uploads: a name is free again after its dataset was removed.
    const auto uploaded = [&](const std::string& contents) {
        const auto answer = program.ask("PUT", "/api/v1/datasets/up/content?filename=up.nrrd", contents);
        EXPECT_EQ(answer.status, 202) << answer.body;
        EXPECT_TRUE(program.waitForImports());
        EXPECT_EQ(program.ask("PATCH", kSheet + "/cells/A1", R"({"source": "up"})").status, 200);
        return picture().body;
    };
    EXPECT_TRUE(uploaded(reversedNrrd()) == second.body);
    EXPECT_EQ(program.ask("PUT", "/api/v1/datasets/up/content?filename=up.nrrd", sampleNrrd(0)).status, 409);
    EXPECT_EQ(program.ask("DELETE", "/api/v1/datasets/up").status, 204);
    EXPECT_TRUE(uploaded(sampleNrrd(0)) == first.body);
}

TEST(ApiShutdown, TermEndsWithinTwoSecondsWithOpenStreams) {
    ServedProgram program(1);
    std::list<RawClient> streams;
    for (int i = 0; i < 16; ++i) {
        streams.emplace_back(program.port());
        streams.back().send("GET " + kSheet +
                            "/stream?width=100&height=100 HTTP/1.1\r\nHost: localhost\r\nAuthorization: "
                            "Bearer " +
                            program.token() + "\r\n\r\n");
    }
    for (auto& stream : streams)
        EXPECT_EQ(statusOfResponse(stream.readResponse(10.0)), 200);
    EXPECT_EQ(program.stop(SIGTERM, 2.0), 0);
}

TEST(ApiLook, ServeBeginsWithThePresetAndTheSettingsThatItWasGiven) {
    // A file follows --set: it must not be taken for another setting.
    ServedProgram program(2, {"--preset", "both-signs", "--set", "isovalue=40", "--set", "B1:technique=mip"});
    const auto cells = program.get("/api/v1/state").json().at("sheets").at(0).at("cells");
    const auto said = [&](std::size_t cell, const char* key) { return cells.at(cell).at("style").at(key); };
    EXPECT_EQ(said(0, "technique").at("value"), "isosurface");
    EXPECT_EQ(said(0, "technique").at("origin"), "sheet");
    EXPECT_EQ(said(0, "isosurface.mirror").at("value"), "on");
    EXPECT_EQ(said(0, "isovalue").at("origin"), "sheet");
    EXPECT_EQ(said(1, "technique").at("value"), "mip");
    EXPECT_EQ(said(1, "technique").at("origin"), "cell");
}

} // namespace
