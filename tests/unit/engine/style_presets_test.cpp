#include "engine/colour_map.h"
#include "engine/config_files.h"
#include "sheet/style_presets.h"

#include "base/errors.h"
#include "sheet/style.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxsheet::engine {
namespace {

const sheet::KeyTable& keys() {
    static const sheet::KeyTable table = sheet::makeKeyTable(ColourMapTable::embedded().names());
    return table;
}

std::vector<sheet::StylePreset> embeddedPresets() {
    return sheet::parseStylePresets(configFile("style_presets.json"), keys());
}

TEST(StylePresets, AllThatTheProgramCarriesAreValidAndAgree) {
    const auto presets = embeddedPresets();
    ASSERT_GE(presets.size(), 8U);
    for (const auto& preset : presets) {
        EXPECT_FALSE(preset.label.empty()) << preset.name;
        EXPECT_FALSE(preset.doc.empty()) << preset.name;
        sheet::Workbook workbook;
        for (const auto& [key, value] : preset.style)
            if (value) workbook.sheets[0].style[key] = *value;
        EXPECT_NO_THROW(
            sheet::requireConsistent(sheet::resolveStyle(keys(), workbook.sheets[0], {0, 0}).style))
            << preset.name;
    }
}

TEST(StylePresets, EachResetsWhatTheOthersSet) {
    const auto presets = embeddedPresets();
    for (const auto& one : presets)
        for (const auto& other : presets)
            for (const auto& [key, value] : other.style)
                EXPECT_EQ(one.style.count(key), 1U) << one.name << " leaves " << key << " of " << other.name;
}

TEST(StylePresets, NamesAreFoundOrExplained) {
    const auto presets = embeddedPresets();
    EXPECT_EQ(sheet::presetNamed(presets, "mip").name, "mip");
    try {
        (void)sheet::presetNamed(presets, "isosurfaces");
        FAIL() << "found";
    } catch (const NotFound& error) {
        EXPECT_NE(error.toDo().find("isosurface"), std::string::npos);
    }
}

TEST(StylePresets, MistakesOfTheFileAreErrors) {
    const auto refused = [](const char* text) {
        EXPECT_THROW((void)sheet::parseStylePresets(text, keys()), InvalidInput) << text;
    };
    refused(R"({"keys": ["no.such.key"], "presets": []})");
    refused(
        R"({"keys": [], "presets": [{"name": "a", "label": "A", "doc": "d", "style": {"technique": "mip"}}]})");
    refused(
        R"({"keys": ["technique"], "presets": [{"name": "a", "label": "A", "doc": "d", "style": {"technique": "x"}}]})");
    refused(R"({"keys": ["technique"], "presets": [{"name": "a", "label": "A", "doc": "d", "style": {}},
                                                     {"name": "a", "label": "B", "doc": "d", "style": {}}]})");
    refused(R"({"keys": []})");
}

} // namespace
} // namespace voxsheet::engine
