// By which path each technique is drawn: by rule, forced by --path, or as a calibration found.
#include "served_program.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

const std::string kImage =
    "/api/v1/sheets/Sheet1/cells/A1/image.png?width=40&height=30&sampling.distance=0.5&technique=";

/// A user's cache of its own, for the programs that are started meanwhile.
class OwnCache {
public:
    OwnCache() : folder_(fs::temp_directory_path() / ("voxsheet_paths_" + std::to_string(::getpid()))) {
        if (const char* before = std::getenv("XDG_CACHE_HOME")) before_ = before;
        fs::create_directories(folder_);
        setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    }
    ~OwnCache() {
        if (before_)
            setenv("XDG_CACHE_HOME", before_->c_str(), 1);
        else
            unsetenv("XDG_CACHE_HOME");
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    OwnCache(const OwnCache&) = delete;
    OwnCache& operator=(const OwnCache&) = delete;

private:
    fs::path folder_;
    std::optional<std::string> before_;
};

/// Exit status and what it prints on the stream.
std::pair<int, std::string> run(const std::string& arguments, const char* streams) {
    FILE* pipe = ::popen((VOXSHEET_BINARY_DIR "/voxsheet " + arguments + " " + streams).c_str(), "r");
    std::string text;
    std::array<char, 512> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr)
        text += part.data();
    const int status = ::pclose(pipe);
    return {WEXITSTATUS(status), text};
}

json pathOf(const ServedProgram& program, const char* technique) {
    return program.get("/api/v1").json().at("paths").at(technique);
}

bool hasKernels(const ServedProgram& program) {
    return pathOf(program, "raycast").at("candidates").size() > 1;
}

TEST(ApiPaths, AForcedPathIsToldAndIsPartOfTheIdentityOfItsTilesAlone) {
    const OwnCache cache;
    const ServedProgram byRule(1);
    ASSERT_TRUE(byRule.waitForImports());
    EXPECT_EQ(pathOf(byRule, "surface"),
              (json{{"path", "shader"}, {"why", "rule"}, {"candidates", {"shader"}}}));
    if (!hasKernels(byRule)) GTEST_SKIP() << "one path only";
    const auto rule = pathOf(byRule, "raycast");
    EXPECT_EQ(rule.at("why"), "rule");
    const std::string other = rule.at("path") == "simd" ? "shader" : "simd";
    const std::string data = byRule.folder() / "a.nrrd";
    const ServedProgram forced(0, {data, "--root", byRule.folder(), "--path", "raycast=" + other});
    ASSERT_TRUE(forced.waitForImports());
    EXPECT_EQ(pathOf(forced, "raycast").at("path"), other);
    EXPECT_EQ(pathOf(forced, "raycast").at("why"), "forced");
    EXPECT_EQ(pathOf(forced, "mip"), pathOf(byRule, "mip"));
    const auto tagOf = [](const ServedProgram& program, const char* technique) {
        const auto answer = program.get(kImage + technique);
        EXPECT_EQ(answer.status, 200) << answer.body;
        return answer.field("ETag");
    };
    EXPECT_FALSE(tagOf(forced, "raycast").empty());
    EXPECT_NE(tagOf(forced, "raycast"), tagOf(byRule, "raycast"));
    for (const char* technique : {"mip", "slices"})
        EXPECT_EQ(tagOf(forced, technique), tagOf(byRule, technique)) << technique;
}

TEST(ApiPaths, ACalibrationIsRememberedUntilItIsForgottenAndOverridden) {
    const OwnCache cache;
    const auto [status, text] = run("bench calibrate --dim 16 --pixels 32 --frames 6 --json", "2>/dev/null");
    ASSERT_EQ(status, 0) << text;
    const auto told = json::parse(text);
    const ServedProgram program(0);
    if (!hasKernels(program)) GTEST_SKIP() << "one path only";
    const auto raycast = pathOf(program, "raycast");
    EXPECT_EQ(raycast.at("why"), "calibrated");
    EXPECT_EQ(raycast.at("path"), told.at("chosen").at("raycast").at("path"));
    EXPECT_EQ(raycast.at("date"), told.at("chosen").at("raycast").at("date"));
    EXPECT_EQ(raycast.at("ratio"), told.at("chosen").at("raycast").at("ratio"));
    EXPECT_EQ(pathOf(program, "surface").at("why"), "rule");
    const ServedProgram overridden(0, {"--path", "raycast=shader"});
    EXPECT_EQ(pathOf(overridden, "raycast").at("why"), "forced");
    EXPECT_EQ(pathOf(overridden, "raycast").at("path"), "shader");
    EXPECT_EQ(pathOf(overridden, "mip").at("why"), "calibrated");
    std::ofstream(told.at("file").get<std::string>()) << "{";
    EXPECT_EQ(pathOf(ServedProgram(0), "raycast").at("why"), "rule") << "a damaged file counts as none";
    EXPECT_EQ(run("bench calibrate --forget --json", "2>/dev/null").first, 0);
    EXPECT_FALSE(fs::exists(told.at("file").get<std::string>()));
}

TEST(ApiPaths, BadPathsAreWrongUsage) {
    for (const std::string bad : {"warp=shader", "raycast=warp", "surface=simd", "raycast"}) {
        const auto [status, text] = run("serve --port 0 --path " + bad, "2>&1 >/dev/null");
        EXPECT_EQ(status, 2) << bad << ": " << text;
        EXPECT_NE(text.find("voxsheet: error: --path: "), std::string::npos) << text;
        EXPECT_NE(text.find(bad == "raycast" ? "for example" : "choose of"), std::string::npos) << text;
    }
}

} // namespace
