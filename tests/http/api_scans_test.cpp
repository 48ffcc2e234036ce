// What scans need of the real program: ranges of values, planes beside a volume, cameras of linked cells.
#include "raw_client.h"
#include "shared_program.h"

#include <gtest/gtest.h>

#include <string>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";

struct ApiScans : SharedProgram<ApiScans> {
    static constexpr int datasets = 2;
    static std::vector<std::string> arguments() { return {"--columns", "1"}; }
};

TEST_F(ApiScans, RangesOfValuesOverDataTimeAndWhatThePictureShows) {
    const auto range = kSheet + "/cells/A1/range";
    // Values are x + 10 y + 3 z + offset of 12 x 10 x 8 samples.
    const auto all = getJson(range);
    EXPECT_EQ(all.at("over"), "data");
    const double low = all.at("min");
    EXPECT_EQ(all.at("max"), low + 11 + 90 + 21);
    EXPECT_EQ(getJson(range + "?over=time").at("max"), all.at("max"));
    EXPECT_EQ(getJson(range + "?over=visible").at("min"), low);
    const auto plane = range + "?over=visible&technique=plane&plane.axis=sagittal&plane.position=";
    EXPECT_EQ(getJson(plane + "0").at("min"), low);
    EXPECT_EQ(getJson(plane + "0").at("max"), low + 90 + 21)
        << "x = 0 alone, or the box would not begin there";
    EXPECT_EQ(getJson(plane + "0&camera.target=50,50,50").at("min"), nullptr)
        << "the picture shows none of it";
    EXPECT_EQ(program_->get(range + "?over=everything").json().at("field"), "over");
    EXPECT_EQ(program_->get(kSheet + "/cells/B2/range").status, 404);
}

TEST_F(ApiScans, APictureWithoutItsSurfaceSaysWhy) {
    const auto image = kSheet + "/cells/A1/image.png?width=32&height=32&technique=isosurface&isovalue=";
    EXPECT_EQ(program_->get(image + "100").field("X-Voxsheet-Note"), "");
    const auto note = program_->get(image + "9999").field("X-Voxsheet-Note");
    EXPECT_NE(note.find("no surface is drawn"), std::string::npos) << note;
    const auto sheet =
        program_->get(kSheet + "/image.png?width=400&height=400&technique=isosurface&isovalue=9999");
    EXPECT_NE(sheet.field("X-Voxsheet-Note").find("cell A1: no surface is drawn"), std::string::npos)
        << sheet.status << " " << sheet.field("X-Voxsheet-Note") << sheet.body.substr(0, 300);
}

TEST_F(ApiScans, PlanesStandBesideEveryNamedCellAsOneUndoStep) {
    const auto before = getJson("/api/v1/workbook");
    EXPECT_EQ(program_->ask("POST", kSheet + "/planes", R"({"cells": []})").json().at("field"), "cells");
    EXPECT_EQ(program_->ask("POST", kSheet + "/planes", R"({"cells": ["Z99"]})").status, 404);
    const auto made = program_->ask("POST", kSheet + "/planes", R"({"cells": ["A1", "A2"]})");
    EXPECT_EQ(made.status, 200) << made.body;
    const auto sheet = getJson(kSheet);
    EXPECT_EQ(sheet.at("columns"), 4);
    const auto cell = getJson(kSheet + "/cells/D2");
    EXPECT_EQ(cell.at("source").at("dataset"), getJson(kSheet + "/cells/A2").at("source").at("dataset"));
    EXPECT_EQ(cell.at("plane.axis"), "sagittal");
    EXPECT_EQ(cell.at("resolved").at("plane.crosshair").at("value"), json::array({0.5, 0.5, 0.5}));
    const auto image = program_->get(kSheet + "/cells/D2/image.png?width=64&height=64&plane.crosshair=0,0,0");
    EXPECT_EQ(image.status, 200) << image.body;
    EXPECT_EQ(program_->ask("POST", "/api/v1/undo").status, 200);
    EXPECT_EQ(getJson("/api/v1/workbook"), before);
}

TEST_F(ApiScans, ALabelMapAndAnOverlayTellTheirNamesAndValues) {
    // Values are x + 10 y + 3 z + offset.
    ASSERT_EQ(
        program_
            ->ask(
                "PATCH", kSheet + "/cells/A2",
                R"({"labels.show": "on", "labels.names": "60: liver #ff0000; 61: spleen", "labels.hide": [[61]]})")
            .status,
        200);
    const auto bar = getJson(kSheet + "/cells/A2/colourbar").at("labels");
    const auto named = [&](int value) -> json {
        for (const auto& label : bar)
            if (label.at("value") == value) return label;
        return nullptr;
    };
    ASSERT_TRUE(named(60).is_object()) << bar;
    EXPECT_EQ(named(60).at("name"), "liver");
    EXPECT_EQ(named(60).at("colour"), json::array({1.0, 0.0, 0.0}));
    EXPECT_TRUE(named(61).at("hidden"));
    ASSERT_EQ(
        program_->ask("PATCH", kSheet + "/cells/A1", R"({"technique": "plane", "overlay.dataset": "A2"})")
            .status,
        200);
    EXPECT_EQ(getJson(kSheet + "/cells/A1/colourbar").at("layers").at(0).at("name"), "A2");
    const auto values = getJson(kSheet + "/probe?x=4&y=4&z=5").at("values"); // 59 and, one more, 60
    EXPECT_EQ(values.at(0).at("label"), nullptr);
    EXPECT_EQ(values.at(1).at("label"), "liver") << values;
    EXPECT_EQ(values.at(0).at("layers").at(0).at("label"), "liver");
    const auto refused =
        program_->get(kSheet + "/cells/A2/image.png?width=64&height=64&technique=isosurface");
    EXPECT_EQ(refused.status, 400);
    EXPECT_EQ(refused.json().at("field"), "labels.show");
    const auto nothing = program_->get(kSheet + "/cells/A1/image.png?width=64&height=64&overlay.dataset=Z9");
    EXPECT_EQ(nothing.json().at("field"), "overlay.dataset");
    for (int i = 0; i < 2; ++i)
        EXPECT_EQ(program_->ask("POST", "/api/v1/undo").status, 200);
}

TEST_F(ApiScans, CellsSayWhatTheirCamerasLengthsReferTo) {
    const auto frame = [&](const std::string& cell) {
        return getJson(kSheet + "/cells/" + cell).at("frame");
    };
    EXPECT_EQ(frame("A1").at("size"), nullptr);
    const double radius = frame("A1").at("radius");
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", R"({"camera.frame": "world"})").status, 200);
    EXPECT_EQ(frame("A1"), frame("A2"));
    EXPECT_EQ(frame("A1").at("size").size(), 3U);
    EXPECT_GE(frame("A1").at("radius").get<double>(), radius);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", R"({"camera.frame": "nearby"})").json().at("field"),
              "camera.frame");
    EXPECT_EQ(program_->ask("POST", "/api/v1/undo").status, 200);
}

TEST(ApiScansProgram, PlanesCanBeAskedForOnTheCommandLine) {
    const ServedProgram program(2, {"--columns", "1", "--planes", "--set", "plane.crosshair=0.2,0.3,0.4"});
    ASSERT_TRUE(program.waitForImports());
    EXPECT_EQ(program.get(kSheet).json().at("columns"), 4);
    const auto cell = program.get(kSheet + "/cells/C2").json();
    EXPECT_EQ(cell.at("plane.axis"), "coronal");
    EXPECT_EQ(cell.at("state"), "ok");
    EXPECT_EQ(cell.at("resolved").at("plane.crosshair").at("value"), json::array({0.2, 0.3, 0.4}));
}

TEST(ApiScansProgram, FormulasCanStandAmongTheFilesOfTheCommandLine) {
    const ServedProgram program(2, {"=A2-C1", "=A1-Q9", "--columns", "3"}); // The files come last.
    ASSERT_TRUE(program.waitForImports());
    EXPECT_EQ(program.get("/api/v1/datasets").json().at("datasets").size(), 2U);
    EXPECT_EQ(program.get(kSheet + "/cells/A1/image.png?width=64&height=64").status, 200) << "computed now";
    const auto probe = program.get(kSheet + "/probe?x=3&y=4&z=5").json().at("values");
    const auto valueOf = [&](const std::string& cell) -> json {
        for (const auto& each : probe)
            if (each.at("cell") == cell) return each.value("value", json());
        return {};
    };
    for (const char* cell : {"A1", "C1", "A2"})
        ASSERT_TRUE(valueOf(cell).is_number()) << probe;
    EXPECT_EQ(valueOf("A1").get<double>(), valueOf("A2").get<double>() - valueOf("C1").get<double>());
    const auto wrong = program.get(kSheet + "/cells/B1").json();
    EXPECT_EQ(wrong.at("code"), "#REF!");
    EXPECT_NE(wrong.at("message").get<std::string>().find("Q9"), std::string::npos) << wrong;
}

} // namespace
