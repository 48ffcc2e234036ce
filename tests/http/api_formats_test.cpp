// What a client says about files, and what it learns about them.
#include "shared_program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

struct ApiFormats : SharedProgram<ApiFormats> {
    static constexpr int datasets = 1;
    static std::vector<std::string> arguments() { return {}; }

    static void write(const std::string& name, const std::string& bytes) {
        std::ofstream(program_->folder() / name, std::ios::binary) << bytes;
    }
    static Answer open(const std::string& name, const json& options) {
        const json body{{"files", {name}}, {"place", false}, {"options", options}};
        return program_->ask("POST", "/api/v1/datasets", body.dump(), "Content-Type: application/json\r\n");
    }
    static json opened(const std::string& name, const json& options) {
        const auto answer = open(name, options);
        EXPECT_EQ(answer.status, 202) << answer.body;
        if (answer.status != 202) return {};
        EXPECT_TRUE(program_->waitForImports());
        const auto wanted = answer.json().at("datasets").at(0);
        const auto list = getJson("/api/v1/datasets");
        for (const auto& dataset : list.at("datasets"))
            if (dataset.at("name") == wanted) return dataset;
        return {};
    }
};

TEST_F(ApiFormats, OptionsDescribeVoxelsWithoutAHeader) {
    std::string bytes = "HEAD";
    for (char i = 0; i < 24; ++i)
        bytes += std::string(1, '\0') + i; // 16 bits, big-endian
    write("scan.bin", bytes);
    const auto dataset = opened("scan.bin", {{"dims", {4, 3, 2}},
                                             {"type", "u16"},
                                             {"endian", "big"},
                                             {"skip_bytes", 4},
                                             {"spacing", {0.5, 2, 3}},
                                             {"origin", {10, 20, 30}},
                                             {"flip", {false, false, true}},
                                             {"periodic", {true, false, false}},
                                             {"no_data", 23}});
    ASSERT_EQ(dataset.value("state", ""), "ready") << dataset;
    EXPECT_EQ(dataset.at("dims"), (json{4, 3, 2}));
    EXPECT_EQ(dataset.at("spacing"), (json{0.5, 2.0, 3.0}));
    EXPECT_EQ(dataset.at("origin"), (json{10.0, 20.0, 33.0})) << "the slices' order is turned round";
    EXPECT_EQ(dataset.at("periodic_axes"), (json{true, false, false}));
    EXPECT_EQ(dataset.at("range"), (json{0.0, 22.0})) << "23 is no value";
}

TEST_F(ApiFormats, FlagsAreMaskedAndSidesNamed) {
    std::string bytes;
    for (int i = 0; i < 24; ++i)
        bytes += std::string(1, static_cast<char>(i)) + (i % 3 == 0 ? '\x80' : '\0');
    write("flags.bin", bytes);
    for (const json& mask : {json("0x7fff"), json(32767)}) {
        const auto dataset = opened(
            "flags.bin", {{"dims", {4, 3, 2}}, {"type", "i16"}, {"bit_mask", mask}, {"orientation", "lpi"}});
        ASSERT_EQ(dataset.value("state", ""), "ready") << dataset;
        EXPECT_EQ(dataset.at("range"), (json{0.0, 23.0}));
        EXPECT_EQ(dataset.at("anatomical"), true);
        EXPECT_EQ(dataset.at("direction"), (json{{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}}));
    }
}

TEST_F(ApiFormats, OptionsThatAreWrongAreNamed) {
    write("scan.bin", "x");
    for (const auto& [member, value] : std::vector<std::pair<std::string, json>>{{"dims", {4, 3}},
                                                                                 {"type", "u17"},
                                                                                 {"spacing", {1, 0, 1}},
                                                                                 {"flip", "x"},
                                                                                 {"bit_mask", "bits"},
                                                                                 {"orientation", "LPL"},
                                                                                 {"colour", 1}}) {
        const auto answer = open("scan.bin", {{member, value}});
        EXPECT_EQ(answer.status, 400) << member << answer.body;
        EXPECT_EQ(answer.json().value("field", ""), "options." + member) << answer.body;
    }
}

TEST_F(ApiFormats, NamesOfLabelsComeWithTheDataset) {
    std::string bytes = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n";
    for (char i = 0; i < 8; ++i)
        bytes += i;
    write("organs.nrrd", bytes);
    write("organs.txt", "0 Unknown 0 0 0 0\n3 left-kidney 255 0 51 255\n");
    const auto dataset = opened("organs.nrrd", json::object());
    ASSERT_TRUE(dataset.contains("labels")) << dataset;
    ASSERT_EQ(dataset.at("labels").size(), 2U);
    EXPECT_EQ(dataset.at("labels").at(1).at("value"), 3);
    EXPECT_EQ(dataset.at("labels").at(1).at("name"), "left-kidney");
    EXPECT_EQ(dataset.at("labels").at(1).at("rgb"), (json{1.0, 0.0, 0.2}));
}

} // namespace
