// The resources of the real program: what a script may rely on.
#include "shared_program.h"

#include <gtest/gtest.h>

#include <chrono>
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

} // namespace
