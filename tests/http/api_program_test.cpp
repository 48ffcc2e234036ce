// The program as a whole: random requests, files that change on the disk, and how it begins.
#include "shared_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";

struct ApiProgram : SharedProgram<ApiProgram> {
    static constexpr int datasets = 3;
    static std::vector<std::string> arguments() { return {"--columns", "2"}; }
};

TEST_F(ApiProgram, NoRandomRequestIsAFaultOfTheProgram) {
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
