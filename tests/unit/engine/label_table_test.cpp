#include "engine/label_table.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <set>

namespace voxsheet::engine {
namespace {

/// Of integers, each as often as counted here.
FieldMeta fieldOf(const std::map<std::int64_t, std::uint64_t>& counted) {
    FieldMeta field;
    field.storedType = ScalarType::I16;
    field.steps.resize(1);
    auto& data = field.steps[0];
    data.statistics.min = static_cast<double>(counted.begin()->first);
    data.statistics.max = static_cast<double>(counted.rbegin()->first);
    data.histogram = {data.statistics.min, data.statistics.max, std::vector<std::uint64_t>(256)};
    const double width = data.histogram.high - data.histogram.low;
    for (const auto& [value, count] : counted) {
        const double at =
            width > 0.0 ? (static_cast<double>(value) - data.histogram.low) / width * 256.0 : 0.0;
        data.histogram.counts[static_cast<std::size_t>(std::min(at, 255.0))] += count;
    }
    return field;
}

LabelTable tableOf(const sheet::LabelsStyle& style, const FieldMeta& field, double opacity = 1.0,
                   const std::vector<LabelMeta>& own = {}) {
    return makeLabelTable(style, own, field, 0, opacity, "labels.show");
}

TEST(LabelTable, EveryWholeNumberHasAnEntryOfItsOwn) {
    const auto table = tableOf({}, fieldOf({{-2, 1}, {0, 50}, {1, 3}, {200, 2}}), 0.5);
    ASSERT_EQ(table.table->entries.size(), 203U);
    for (const std::int64_t value : {-2, 1, 200}) {
        const auto entry = classify(*table.table, static_cast<double>(value));
        EXPECT_NEAR(glm::distance(glm::dvec3(entry), labelColour(value)), 0.0, 1e-6);
        EXPECT_EQ(entry.w, 0.5);
    }
    EXPECT_EQ(classify(*table.table, 0.0).w, 0.0) << "the background";
    EXPECT_EQ(classify(*table.table, 201.0).w, 0.0) << "beyond the data";
}

TEST(LabelTable, TheLegendListsWhatTheDataHaveAndWhatIsNamed) {
    sheet::LabelsStyle style;
    style.names = "1: liver #102030; 9: not there";
    style.hidden = {5};
    const auto table = tableOf(style, fieldOf({{0, 50}, {1, 3}, {3, 1}, {5, 2}, {200, 2}}));
    std::vector<std::string> names;
    for (const auto& label : table.labels)
        names.push_back(label.name + (label.hidden ? " (hidden)" : ""));
    EXPECT_EQ(names, (std::vector<std::string>{"liver", "3", "5 (hidden)", "not there", "200"}));
    EXPECT_NEAR(table.labels[0].rgb.x, 0x10 / 255.0, 1e-12);
    EXPECT_EQ(classify(*table.table, 5.0).w, 0.0);
    EXPECT_EQ(table.nameOf(1.0), "liver");
    EXPECT_EQ(table.nameOf(77.0), "77");
}

TEST(LabelTable, ANamedBackgroundIsSeen) {
    sheet::LabelsStyle style;
    style.names = "0: air";
    const auto table = tableOf(style, fieldOf({{0, 1}, {1, 1}}));
    EXPECT_EQ(table.labels.front().name, "air");
    EXPECT_EQ(classify(*table.table, 0.0).w, 1.0);
}

TEST(LabelTable, TheFilesNamesHoldWhereTheStyleSaysNothing) {
    const std::vector<LabelMeta> own{{0, "Clear Label", glm::dvec3(0)},
                                     {1, "liver", glm::dvec3(1, 0, 0)},
                                     {2, "spleen", glm::dvec3(0, 1, 0)},
                                     {3, "gall", std::nullopt}};
    sheet::LabelsStyle style;
    style.names = "1: Leber; 2 #0000ff";
    const auto table = tableOf(style, fieldOf({{0, 5}, {1, 3}, {2, 1}, {3, 1}, {4, 1}}), 1.0, own);
    EXPECT_EQ(table.nameOf(1.0), "Leber");
    EXPECT_EQ(table.nameOf(2.0), "spleen");
    EXPECT_EQ(table.nameOf(3.0), "gall");
    EXPECT_EQ(table.nameOf(4.0), "4");
    EXPECT_EQ(glm::vec3(classify(*table.table, 1.0)), glm::vec3(1, 0, 0)) << "the file's colour";
    EXPECT_EQ(glm::vec3(classify(*table.table, 2.0)), glm::vec3(0, 0, 1)) << "the style's colour";
    EXPECT_EQ(classify(*table.table, 0.0).w, 0.0) << "the background stays clear, also with a name";
}

TEST(LabelTable, OfAWholeAtlasTheLegendListsWhatTheDataMayHave) {
    std::vector<LabelMeta> own;
    for (std::int64_t value = 0; value <= 2035; ++value)
        own.push_back({value, "region " + std::to_string(value), std::nullopt});
    const auto names = [&](const FieldMeta& field) {
        std::vector<std::string> list;
        for (const auto& label : tableOf({}, field, 1.0, own).labels)
            list.push_back(label.name);
        return list;
    };
    EXPECT_EQ(names(fieldOf({{0, 9}, {3, 1}, {77, 1}})), (std::vector<std::string>{"region 3", "region 77"}));
    // Beyond 256 values a bin holds several.
    const auto wide = names(fieldOf({{0, 9}, {2035, 1}}));
    ASSERT_FALSE(wide.empty());
    EXPECT_LE(wide.size(), 16U);
    EXPECT_EQ(wide.back(), "region 2035");
}

TEST(LabelTable, ColoursOfNeighboursAreFarApartAndAlwaysTheSame) {
    for (std::int64_t a = 1; a <= 40; ++a)
        for (std::int64_t b = a + 1; b <= a + 4; ++b)
            EXPECT_GT(glm::distance(labelColour(a), labelColour(b)), 0.15) << a << " and " << b;
    EXPECT_EQ(labelColour(7), labelColour(7));
}

TEST(LabelTable, OneValueAloneIsATableToo) { EXPECT_EQ(tableOf({}, fieldOf({{4, 10}})).labels.size(), 1U); }

TEST(LabelTable, WhatIsNoLabelMapIsRefused) {
    FieldMeta field = fieldOf({{0, 1}, {1, 1}});
    field.storedType = ScalarType::F32;
    EXPECT_THROW((void)tableOf({}, field), InvalidInput);
    field = fieldOf({{0, 1}, {1, 1}});
    field.valueScale = 0.5;
    EXPECT_THROW((void)tableOf({}, field), InvalidInput);
    EXPECT_THROW((void)tableOf({}, fieldOf({{0, 1}, {20000, 1}})), LimitExceeded);
}

} // namespace
} // namespace voxsheet::engine
