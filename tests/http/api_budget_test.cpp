// Budgets of textures and host memory: of the real program, with volumes that do not fit.
#include "served_program.h"
#include "stream_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <sys/wait.h>
#include <thread>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";
constexpr int kDim = 64;
constexpr int kVolumes = 6;
constexpr double kVolumeBytes = kDim * kDim * kDim * 4.0; ///< 1 MiB, as 32-bit floats

std::string volumeFile(int offset) {
    const auto dim = std::to_string(kDim);
    std::string file = "NRRD0004\ntype: float\ndimension: 3\nsizes: " + dim + " " + dim + " " + dim +
                       "\nencoding: raw\nendian: little\n\n";
    for (int z = 0; z < kDim; ++z)
        for (int y = 0; y < kDim; ++y)
            for (int x = 0; x < kDim; ++x) {
                const float value = static_cast<float>((x * y + 5 * z) % (97 + 10 * offset));
                std::array<char, 4> bytes{};
                std::memcpy(bytes.data(), &value, 4);
                file.append(bytes.data(), 4);
            }
    return file;
}

/// With every cell at full level, whatever the budget: what does not fit is swapped.
std::unique_ptr<ServedProgram> serve(const std::string& budget, const std::string& memory = "1G") {
    auto program = std::make_unique<ServedProgram>(
        0, std::vector<std::string>{"--texture-budget", budget, "--memory-budget", memory, "--dr", "off",
                                    "--path", "slices=shader"}); // slices read textures on every device
    for (int i = 0; i < kVolumes; ++i) {
        const auto file = program->folder() / ("v" + std::to_string(i) + ".nrrd");
        std::ofstream(file, std::ios::binary) << volumeFile(i);
        const json body{{"files", {file.string()}}};
        EXPECT_EQ(program->ask("POST", "/api/v1/datasets", body.dump()).status, 202);
    }
    EXPECT_TRUE(program->waitForImports());
    return program;
}

double metric(const ServedProgram& program, const std::string& name) {
    const auto text = "\n" + program.get("/metrics").body;
    const auto at = text.find("\n" + name + " ");
    EXPECT_NE(at, std::string::npos) << name;
    EXPECT_NE(text.find("# HELP " + name.substr(0, name.find('{')) + " "), std::string::npos) << name;
    return at == std::string::npos ? -1.0 : std::stod(text.substr(at + name.size() + 2));
}

/// Of one volume: a texture, or host memory with a border of a texel and a few bytes behind it.
double residentBytes(const ServedProgram& program) {
    const auto workarounds = program.get("/api/v1").json().at("device").at("workarounds").dump();
    const bool onHost = workarounds.find("simd-rays") != std::string::npos;
    return onHost ? (kDim + 2.0) * (kDim + 2) * (kDim + 2) * 4 + 64 : kVolumeBytes;
}

std::vector<std::string> cells(const ServedProgram& program) {
    std::vector<std::string> names;
    const auto workbook = program.get("/api/v1/workbook").json();
    for (const auto& [name, cell] : workbook.at("sheets").at(0).at("cells").items())
        names.push_back(name);
    return names;
}

TEST(ApiBudget, ASheetLargerThanTheTextureBudgetSwapsAndLooksTheSame) {
    const auto roomy = serve("256M");
    const auto tight = serve("2500K"); // two of the six volumes
    const auto names = cells(*roomy);
    ASSERT_EQ(names.size(), static_cast<std::size_t>(kVolumes));
    for (int round = 0; round < 2; ++round)
        for (const auto& name : names) {
            const auto target = kSheet + "/cells/" + name +
                                "/image.png?width=80&height=60&camera.azimuth=" + std::to_string(40 * round);
            const auto expected = roomy->get(target);
            const auto swapped = tight->get(target);
            ASSERT_EQ(expected.status, 200) << expected.body;
            ASSERT_EQ(swapped.status, 200) << swapped.body;
            EXPECT_EQ(swapped.body, expected.body) << name;
            EXPECT_LE(metric(*tight, "voxsheet_texture_bytes"), 2500 * 1024);
        }
    EXPECT_EQ(roomy->get(kSheet + "/image.png?width=400&height=300").body,
              tight->get(kSheet + "/image.png?width=400&height=300").body);
    EXPECT_EQ(metric(*roomy, "voxsheet_texture_bytes"), kVolumes * residentBytes(*roomy));
    EXPECT_EQ(metric(*roomy, "voxsheet_texture_evictions_total"), 0);
    EXPECT_EQ(metric(*roomy, "voxsheet_host_cache_bytes"), 0) << "all is on the device: no second copy";
    EXPECT_EQ(metric(*tight, "voxsheet_texture_bytes"), 2 * residentBytes(*tight));
    EXPECT_EQ(metric(*tight, "voxsheet_texture_kind_bytes{kind=\"samples\"}"), 2 * residentBytes(*tight));
    EXPECT_GE(metric(*tight, "voxsheet_texture_evictions_total"), 6);
    EXPECT_GT(metric(*tight, "voxsheet_host_cache_hits_total"), 0) << "from host memory, not from disk";
    // Whatever was read before the first eviction is read a second time, nothing a third time; min-max grids
    // (a quarter of the samples) beside them. What is on the host anyway is kept from the first eviction on.
    EXPECT_LE(metric(*tight, "voxsheet_store_read_bytes_total"),
              (residentBytes(*tight) > kVolumeBytes ? 1.3 : 2.2) * kVolumes * kVolumeBytes);
    const auto info = tight->get("/api/v1").json();
    EXPECT_EQ(info.at("budgets").at("texture"), 2500 * 1024);
    EXPECT_EQ(info.at("budgets").at("texture_why"), "as asked for");
    EXPECT_EQ(info.at("budgets").at("memory"), 1 << 30);
}

TEST(ApiBudget, WhatIsOverTheMemoryBudgetIsReadAgainFromDisk) {
    const auto program = serve("2500K", "3M");
    const auto names = cells(*program);
    double lastRead = 0.0;
    for (int round = 0; round < 3; ++round) {
        for (const auto& name : names)
            ASSERT_EQ(program
                          ->get(kSheet + "/cells/" + name +
                                "/image.png?width=40&height=30&camera.azimuth=" + std::to_string(40 * round))
                          .status,
                      200);
        const double read = metric(*program, "voxsheet_store_read_bytes_total");
        EXPECT_GE(read - lastRead, kVolumes * kVolumeBytes) << "all of them, each time round";
        lastRead = read;
        EXPECT_LE(metric(*program, "voxsheet_host_cache_bytes"), 3 << 20);
    }
}

TEST(ApiBudget, AStreamTellsWhatIsVisibleAndDrawsWhatFits) {
    const auto program = serve("1124K"); // exactly one volume fits, gradients never
    {
        StreamReader stream(*program, kSheet + "/stream?width=400&height=300&dpr=1");
        ASSERT_EQ(stream.status(), 200);
        const auto path = "/api/v1/streams/" + stream.next("hello").header.at("stream").get<std::string>();
        std::map<std::string, int> finalLevels;
        for (int i = 0; i < 200 && finalLevels.size() < kVolumes; ++i) {
            const auto tile = stream.next("tile");
            ASSERT_TRUE(tile.header.is_object()) << i;
            if (tile.header.at("final") == true)
                finalLevels[tile.header.at("cell")] = tile.header.at("level").get<int>();
            static_cast<void>(program->ask(
                "POST", path, json{{"ack", tile.header.at("frame").get<std::uint64_t>()}}.dump()));
        }
        EXPECT_EQ(finalLevels.size(), static_cast<std::size_t>(kVolumes));
        for (const auto& [cell, level] : finalLevels)
            EXPECT_EQ(level, 0) << cell << ": one after another, each at its own level";
        EXPECT_EQ(metric(*program, "voxsheet_texture_visible_bytes"), residentBytes(*program));
        // Textures, and with light gradients too: three times as much, which the budget never holds.
        ASSERT_EQ(
            program
                ->ask("PATCH", kSheet + "/style",
                      R"({"technique": "slices", "shading.model": "phong", "shading.gradient": "texture"})")
                .status,
            200);
        std::string note;
        for (int i = 0; i < 200 && note.empty(); ++i) {
            const auto tile = stream.next("tile");
            ASSERT_TRUE(tile.header.is_object()) << i;
            if (tile.header.at("final") == true && tile.header.contains("note")) {
                note = tile.header.at("note");
                EXPECT_EQ(tile.header.at("level"), 1);
            }
            static_cast<void>(program->ask(
                "POST", path, json{{"ack", tile.header.at("frame").get<std::uint64_t>()}}.dump()));
        }
        EXPECT_NE(note.find("--texture-budget"), std::string::npos) << note;
        // A picture that is asked for by itself is at full level or not at all.
        const auto refused = program->get(kSheet + "/cells/A1/image.png?width=40&height=30");
        EXPECT_GE(refused.status, 400);
        EXPECT_NE(refused.body.find("texture budget"), std::string::npos) << refused.body;
        EXPECT_EQ(program->ask("DELETE", path).status, 204);
    }
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (metric(*program, "voxsheet_texture_visible_bytes") > 0 && std::chrono::steady_clock::now() < until)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(metric(*program, "voxsheet_texture_visible_bytes"), 0) << "nobody looks any more";
}

/// Exit status and stderr of `voxsheet ARGUMENTS`.
std::pair<int, std::string> run(const std::string& arguments) {
    FILE* pipe = ::popen((VOXSHEET_BINARY_DIR "/voxsheet " + arguments + " 2>&1 >/dev/null").c_str(), "r");
    std::string text;
    std::array<char, 512> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr)
        text += part.data();
    const int status = ::pclose(pipe);
    return {WEXITSTATUS(status), text};
}

TEST(ApiBudget, BadBudgetsAreWrongUsage) {
    for (const std::string flag : {"--texture-budget", "--memory-budget"})
        for (const char* bad : {"0", "-1", "abc", "nan", "1X", "10K", "900000G", "1e400"}) {
            const auto [status, text] = run("serve --port 0 " + flag + "=" + bad);
            EXPECT_EQ(status, 2) << flag << " " << bad << ": " << text;
            EXPECT_NE(text.find("voxsheet: error: " + flag + ": "), std::string::npos) << text;
            EXPECT_TRUE(text.find("1 MiB to") != std::string::npos ||
                        text.find("at most that") != std::string::npos)
                << "the bounds: " << text;
        }
}

} // namespace
