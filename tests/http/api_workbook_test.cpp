// Workbooks and formulas over the API: what an edit changes, and what it must not lose.
#include "shared_program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";

struct ApiWorkbook : SharedProgram<ApiWorkbook> {
    static constexpr int datasets = 3;
    static std::vector<std::string> arguments() { return {"--columns", "2"}; }
};

TEST_F(ApiWorkbook, FormulaCell) {
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

TEST_F(ApiWorkbook, WorkbookRoundTripAndLostEdits) {
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

TEST_F(ApiWorkbook, LevelPolicyBelongsToTheWorkbook) {
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

} // namespace
