#include "base/errors.h"
#include "store/meta_json.h"
#include "store_fixture.h"
#include "volume/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace voxsheet::store {
namespace {

DatasetMeta fullMeta() {
    auto meta = sampleMeta("k", {5, 6, 7}, 2, 3);
    meta.grid.worldFromIndex = glm::dmat4(glm::dvec4(0.1, 0.2, 0.3, 0), glm::dvec4(0, 2, 1.0 / 3.0, 0),
                                          glm::dvec4(0, 0, -3, 0), glm::dvec4(1e-3, -7, 1e10, 1));
    meta.grid.centring = Centring::Cell;
    meta.grid.periodic = {true, false, true};
    meta.sourceType = ScalarType::U16;
    meta.lengthUnit = "Å";
    meta.anatomical = true;
    meta.notes = {"a note", "another"};
    meta.crystal =
        Crystal{glm::dmat3(4.775, 0, 0, 0, 4.929, 0, 0.1, 0, 6.897), {{14, {0.5, 0.25, 1.0}}}, "MgSiO3"};
    meta.labels = {{-1, "", glm::dvec3(0.25, 0.5, 1.0)}, {3, "left kidney", std::nullopt}};
    for (auto& field : meta.fields)
        for (std::size_t s = 0; s < meta.times.size(); ++s) {
            FieldStep step;
            step.statistics = {-1.25, 4.0, 0.1, 0.7, 210, 3};
            step.histogram = {-1.25, 4.0, std::vector<std::uint64_t>(kHistogramBins, s + 1)};
            field.steps.push_back(step);
        }
    return meta;
}

TEST(MetaJson, RoundTripIsExact) {
    const auto meta = fullMeta();
    const auto json = metaToJson(meta);
    const auto back = metaFromJson(parseJson(json.dump(), "test"));
    EXPECT_EQ(metaToJson(back), json);
    EXPECT_EQ(back.grid, meta.grid);
    EXPECT_EQ(back.sourceType, ScalarType::U16);
    EXPECT_EQ(back.lengthUnit, "Å");
    EXPECT_TRUE(back.anatomical);
    EXPECT_EQ(back.times, meta.times);
    EXPECT_EQ(back.notes, meta.notes);
    ASSERT_TRUE(back.crystal.has_value());
    EXPECT_EQ(back.crystal->lattice, meta.crystal->lattice);
    EXPECT_EQ(back.crystal->atoms[0].positionWorld, meta.crystal->atoms[0].positionWorld);
    ASSERT_EQ(back.labels.size(), 2U);
    EXPECT_EQ(back.labels[0].value, -1);
    EXPECT_EQ(back.labels[0].rgb, glm::dvec3(0.25, 0.5, 1.0));
    EXPECT_EQ(back.labels[1].name, "left kidney");
    EXPECT_FALSE(back.labels[1].rgb);
    ASSERT_EQ(back.fields.size(), 2U);
    EXPECT_EQ(back.fields[1].steps[2].histogram.counts, meta.fields[1].steps[2].histogram.counts);
    EXPECT_EQ(back.fields[1].steps[2].statistics.standardDeviation, 0.7);
    EXPECT_EQ(back.fields[0].valueScale, 0.5);
}

TEST(MetaJson, RefusesNumbersThatJsonCannotHold) {
    auto meta = fullMeta();
    meta.times[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)metaToJson(meta), InvalidInput);
    meta = fullMeta();
    meta.fields[0].valueScale = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)metaToJson(meta), InvalidInput);
}

TEST(MetaJson, EveryMemberMissingOrOfAnotherTypeIsAnError) {
    const auto json = metaToJson(fullMeta());
    for (const auto& [name, value] : json.items()) {
        auto wrong = json;
        wrong[name] = value.is_object() ? nlohmann::json("text") : nlohmann::json::object();
        EXPECT_THROW((void)metaFromJson(wrong), InvalidInput) << name;
        if (name == "crystal" || name == "labels") continue; // may be absent
        wrong.erase(name);
        EXPECT_THROW((void)metaFromJson(wrong), InvalidInput) << name;
    }
    auto wrong = json;
    wrong["grid"]["dims"] = {0, 1, 1};
    EXPECT_THROW((void)metaFromJson(wrong), InvalidInput);
    wrong["grid"]["dims"] = {2147483647, 1, 1};
    EXPECT_THROW((void)metaFromJson(wrong), InvalidInput);
    wrong = json;
    wrong["fields"][0]["stored_type"] = "f16";
    EXPECT_THROW((void)metaFromJson(wrong), InvalidInput);
}

TEST(MetaJson, WholeNumbersAreNotConvertedFromOthers) {
    const auto json = metaToJson(fullMeta());
    const std::vector<nlohmann::json::json_pointer> places{
        "/grid/dims/0"_json_pointer,
        "/fields/0/steps/0/finite_count"_json_pointer,
        "/fields/0/steps/0/nan_count"_json_pointer,
        "/fields/0/steps/0/histogram/counts/5"_json_pointer,
        "/crystal/atoms/0/atomic_number"_json_pointer,
        "/labels/1/value"_json_pointer,
    };
    for (const auto& place : places) {
        ASSERT_TRUE(json.at(place).is_number_integer()) << place.to_string();
        for (const char* bad : {"8.8e20", "-1e300", "1.5", "true", "\"3\"", "null", "18446744073709551616"}) {
            auto wrong = json;
            wrong[place] = nlohmann::json::parse(bad);
            EXPECT_THROW((void)metaFromJson(wrong), InvalidInput) << place.to_string() << " = " << bad;
        }
    }
    auto wrong = json;
    wrong["/fields/0/steps/0/finite_count"_json_pointer] = -1;
    EXPECT_THROW((void)metaFromJson(wrong), InvalidInput);
    wrong = json;
    wrong["/crystal/atoms/0/atomic_number"_json_pointer] = std::int64_t{1} << 40;
    EXPECT_THROW((void)metaFromJson(wrong), InvalidInput);
    wrong = json;
    wrong["/fields/0/steps/0/finite_count"_json_pointer] = UINT64_MAX;
    EXPECT_EQ(metaFromJson(wrong).fields[0].steps[0].statistics.finiteCount, UINT64_MAX);
}

TEST(MetaJson, DeepNestingIsACleanError) {
    EXPECT_THROW((void)parseJson(std::string(100000, '['), "test"), InvalidInput);
    EXPECT_THROW((void)parseJson("{\"a\":", "test"), InvalidInput);
    EXPECT_EQ(parseJson("{\"a\":[1,2]}", "test")["a"][1], 2);
}

} // namespace
} // namespace voxsheet::store
