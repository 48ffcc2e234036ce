#include "cli/import_arguments.h"

#include "base/errors.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

namespace voxsheet::cli {
namespace {

using nlohmann::json;

ImportArguments parsed(std::vector<std::string> words) {
    CLI::App app;
    ImportArguments arguments;
    std::vector<std::string> files;
    app.add_option("SOURCES", files);
    addImportArguments(app, arguments);
    std::reverse(words.begin(), words.end()); // as CLI11 wants them
    app.parse(words);
    return arguments;
}

TEST(ImportArguments, EveryOptionOfTheApiIsThere) {
    const auto arguments = parsed(
        {"--dims",       "4x5x6", "--type",    "i16",   "--endian",   "big",      "--skip-bytes",  "12",
         "--components", "2",     "--spacing", "0.5",   "--origin",   "-1,2e1,3", "--flip",        "xz",
         "--periodic",   "none",  "--no-data", "-9999", "--bit-mask", "0x7fff",   "--orientation", "lpi"});
    EXPECT_EQ(importOptionsFor(arguments, "a.raw"), json::parse(R"({
        "dims": [4, 5, 6], "type": "i16", "endian": "big", "skip_bytes": 12, "components": 2,
        "spacing": [0.5, 0.5, 0.5], "origin": [-1, 20.0, 3], "flip": [true, false, true],
        "periodic": [false, false, false], "no_data": -9999,
        "bit_mask": "0x7fff", "orientation": "lpi"})"));
}

TEST(ImportArguments, APatternNamesSomeFilesAndALaterSettingWins) {
    const auto arguments = parsed(
        {"--dims", "4,4,4", "--import", "after*.raw:dims=8,8,8", "--import", "*/b/*:flip=z", "--type", "u8"});
    EXPECT_EQ(importOptionsFor(arguments, "/data/before.raw"),
              json::parse(R"({"dims": [4, 4, 4], "type": "u8"})"));
    EXPECT_EQ(importOptionsFor(arguments, "/data/b/after 1.raw")["dims"], json({8, 8, 8}));
    EXPECT_EQ(importOptionsFor(arguments, "/data/b/after 1.raw")["flip"], json({false, false, true}));
}

TEST(ImportArguments, MistakesNameTheOption) {
    for (const auto& [option, value] :
         std::vector<std::pair<std::string, std::string>>{{"--dims", "4x4"},
                                                          {"--dims", "4,4,0"},
                                                          {"--dims", "a,4,4"},
                                                          {"--type", "u7"},
                                                          {"--spacing", "-1"},
                                                          {"--flip", "w"},
                                                          {"--no-data", "nothing"},
                                                          {"--bit-mask", "0"},
                                                          {"--bit-mask", "0x7fffq"},
                                                          {"--orientation", "LRS"},
                                                          {"--import", "dims"},
                                                          {"--import", "colour=red"}}) {
        try {
            (void)importOptionsFor(parsed({option, value}), "a.raw");
            ADD_FAILURE() << option << " " << value << " was taken";
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.field(), option) << error.what();
        }
    }
}

TEST(ImportArguments, DatasetsGetTheirOptionsAndAPatternForNothingIsAMistake) {
    sheet::Workbook workbook;
    workbook.datasets["a"].files = {"/data/a.raw"};
    workbook.datasets["b"].files = {"/data/b.raw"};
    setImportOptions(workbook, parsed({"--import", "a.*:flip=x"}));
    EXPECT_EQ(workbook.datasets["a"].options, R"({"flip":[true,false,false]})");
    EXPECT_EQ(workbook.datasets["b"].options, "{}");
    EXPECT_THROW(setImportOptions(workbook, parsed({"--import", "c.*:flip=x"})), InvalidInput);
}

} // namespace
} // namespace voxsheet::cli
