#include "sheet/style_keys.h"

#include "sheet_fixture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::sheet {
namespace {

using nlohmann::json;

// --- every key of the table ---

class EveryKey : public testing::TestWithParam<std::string> {
protected:
    [[nodiscard]] const KeySpec& key() const { return testKeys().at(GetParam()); }

    void refusesJson(const json& value) const {
        const Error error = caught<InvalidInput>([&] { (void)parseStyleValue(key(), value); });
        EXPECT_EQ(error.field(), key().name) << value.dump();
        EXPECT_NE(std::string(error.what()).find(key().name), std::string::npos);
        EXPECT_FALSE(error.toDo().empty());
    }
    [[nodiscard]] bool isNumeric() const {
        return key().type == KeyType::Number || key().type == KeyType::Integer;
    }
    [[nodiscard]] bool isColumn() const {
        return key().type == KeyType::NumberRows && key().columnNames.size() == 1;
    }
    [[nodiscard]] bool takesAnyWord() const {
        return key().type == KeyType::FieldName || key().type == KeyType::Text;
    }
};

std::vector<std::string> keyNames() {
    std::vector<std::string> names;
    for (const KeySpec& key : testKeys().keys())
        names.push_back(key.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Table, EveryKey, testing::ValuesIn(keyNames()), [](const auto& parameter) {
    std::string name = parameter.param;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

TEST_P(EveryKey, IsDocumented) {
    EXPECT_FALSE(key().doc.empty());
    EXPECT_FALSE(key().group.empty());
    EXPECT_FALSE(key().widget.empty());
    EXPECT_EQ(key().type == KeyType::Choice, !key().choices.empty());
}

TEST_P(EveryKey, DefaultReadsBackFromJsonAndText) {
    const StyleValue& value = key().defaultValue;
    EXPECT_EQ(parseStyleValue(key(), styleValueToJson(value)), value);
    EXPECT_EQ(parseStyleText(key(), styleValueText(value)), value);
}

TEST_P(EveryKey, RefusesOtherTypes) {
    refusesJson(true);
    refusesJson(nullptr);
    refusesJson(json::object());
    refusesJson(json::array());
    refusesJson(json::array({json::array()}));
    refusesJson("");
    if (!takesAnyWord()) refusesJson("no such word");
    if (key().type != KeyType::FieldName && !isNumeric() && !isColumn()) refusesJson(1);
    if (isNumeric()) refusesJson("1");
}

TEST_P(EveryKey, TakesNoneAndAutoOnlyWhereItSaysSo) {
    const bool isWord = takesAnyWord() || key().type == KeyType::Choice;
    if (isWord) return; // there, they are words like others
    if (key().takesNone)
        EXPECT_EQ(parseStyleValue(key(), "none"), StyleValue(None{}));
    else
        refusesJson("none");
    if (key().takesAuto)
        EXPECT_EQ(parseStyleValue(key(), "auto"), StyleValue(Automatic{}));
    else
        refusesJson("auto");
}

TEST_P(EveryKey, KeepsItsBounds) {
    if (key().type == KeyType::Vector3) {
        refusesJson(json::array({0, 0}));
        refusesJson(json::array({0, 0, 0, 0}));
        refusesJson(json::array({0, 0, key().max * 1.01}));
        refusesJson(json::array({key().min - 0.01 * std::abs(key().min), 0, 0}));
        const double between = std::max(0.0, key().min);
        EXPECT_EQ(parseStyleValue(key(), json::array({key().min, between, key().max})),
                  StyleValue(glm::dvec3(key().min, between, key().max)));
    }
    if (key().type == KeyType::NumberRows) {
        const json row(std::vector<double>(key().columnNames.size(), 0.5));
        refusesJson(json(std::vector<json>(key().maxRows + 1, row)));
        refusesJson(json::array({json(std::vector<double>(key().columnNames.size() + 1, 0.5))}));
        json beyond = row;
        beyond.back() = key().max * 1.01;
        refusesJson(json::array({beyond}));
        EXPECT_EQ(parseStyleValue(key(), json::array({row})),
                  StyleValue(NumberTable{{row.get<std::vector<double>>()}}));
    }
    if (!isNumeric()) return;
    ASSERT_LT(key().min, key().max);
    const double step = key().type == KeyType::Integer ? 1.0 : 0.0;
    const auto below = [&](double v) { return step > 0 ? v - step : std::nextafter(v, -1e308); };
    const auto above = [&](double v) { return step > 0 ? v + step : std::nextafter(v, 1e308); };
    refusesJson(below(key().min));
    refusesJson(above(key().max));
    EXPECT_NO_THROW((void)parseStyleValue(key(), key().min));
    EXPECT_NO_THROW((void)parseStyleValue(key(), key().max));
    const Error error = caught<InvalidInput>([&] { (void)parseStyleValue(key(), above(key().max)); });
    EXPECT_NE(error.toDo().find("from"), std::string::npos) << "names the bounds";
}

TEST_P(EveryKey, RefusesNumbersThatAreNone) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(validateStyleValue(key(), value), InvalidInput);
        EXPECT_THROW(validateStyleValue(key(), glm::dvec3(0.0, value, 0.0)), InvalidInput);
        EXPECT_THROW(validateStyleValue(key(), OpacityStops{{0.0, 0.0}, {value, 0.5}}), InvalidInput);
        EXPECT_THROW(validateStyleValue(key(), OpacityStops{{0.0, value}}), InvalidInput);
        EXPECT_THROW(validateStyleValue(key(), ColourStops{{value, Colour{}}}), InvalidInput);
        EXPECT_THROW(
            validateStyleValue(key(), NumberTable{{std::vector<double>(
                                          std::max<std::size_t>(key().columnNames.size(), 1), value)}}),
            InvalidInput);
    }
    if (takesAnyWord()) return;
    for (const char* text : {"nan", "inf", "-inf", "infinity", "1e999", "0x10", "--1"})
        EXPECT_THROW((void)parseStyleText(key(), text), InvalidInput) << text;
    if (isColumn()) return; // two numbers there
    for (const char* text : {"1,5", "1 "})
        EXPECT_THROW((void)parseStyleText(key(), text), InvalidInput) << text;
}

// --- the kinds of values ---

TEST(StyleKeys, UnknownKeysNameTheNearest) {
    const Error error = caught<InvalidInput>([] { (void)testKeys().at("camera.azimut"); });
    EXPECT_EQ(error.field(), "camera.azimut");
    EXPECT_NE(error.toDo().find("camera.azimuth"), std::string::npos);
    EXPECT_NE(caught<InvalidInput>([] { (void)testKeys().at("azimuth"); }).toDo().find("camera.azimuth"),
              std::string::npos);
    EXPECT_EQ(caught<InvalidInput>([] { (void)testKeys().at("zzz"); }).toDo().find("did you mean"),
              std::string::npos);
    EXPECT_THROW((void)testKeys().at(""), InvalidInput);
    EXPECT_THROW((void)testKeys().at(std::string(100000, 'x')), InvalidInput);
}

TEST(StyleKeys, ChoicesNameTheNearest) {
    const Error error =
        caught<InvalidInput>([] { (void)parseStyleText(testKeys().at("transfer.map"), "virdis"); });
    EXPECT_NE(error.toDo().find("did you mean \"viridis\""), std::string::npos) << error.what();
    EXPECT_NE(error.toDo().find("cool-warm"), std::string::npos) << "lists the choices";
}

TEST(StyleKeys, DefaultMapIsViridisOrTheFirst) {
    EXPECT_EQ(testKeys().at("transfer.map").defaultValue, StyleValue(std::string("viridis")));
    EXPECT_EQ(makeKeyTable({"b", "a"}).at("transfer.map").defaultValue, StyleValue(std::string("b")));
    EXPECT_THROW((void)makeKeyTable({}), InvalidInput);
}

TEST(StyleKeys, ColoursInAllSpellings) {
    const KeySpec& key = testKeys().at("background");
    EXPECT_EQ(parseStyleText(key, "#ff8000"), StyleValue(Colour{{255, 128, 0, 255}}));
    EXPECT_EQ(parseStyleText(key, "FF8000"), StyleValue(Colour{{255, 128, 0, 255}}));
    EXPECT_EQ(parseStyleText(key, "#f80"), StyleValue(Colour{{255, 136, 0, 255}}));
    EXPECT_EQ(parseStyleText(key, "#ff800080"), StyleValue(Colour{{255, 128, 0, 128}}));
    EXPECT_EQ(parseStyleText(key, "transparent"), StyleValue(Colour{{0, 0, 0, 0}}));
    for (const char* text : {"#", "#ff", "#ff80", "#ff800", "#gg8000", "##ff8000", "red", "#ff8000000"})
        EXPECT_THROW((void)parseStyleText(key, text), InvalidInput) << text;
}

TEST(StyleKeys, EveryColourReadsBack) {
    for (int i = 0; i < 256; ++i) {
        const auto byte = static_cast<std::uint8_t>(i);
        for (const Colour& colour :
             {Colour{{byte, 0, 7, 255}}, Colour{{0, byte, 0, 0}}, Colour{{1, 2, 3, byte}}})
            EXPECT_EQ(parseColour(colourName(colour)), colour) << colourName(colour);
    }
}

TEST(StyleKeys, PointsFromJsonAndText) {
    const KeySpec& opacity = testKeys().at("transfer.opacity");
    const OpacityStops ramp{{0.0, 0.0}, {0.3, 0.1}, {1.0, 0.8}};
    EXPECT_EQ(parseStyleText(opacity, "0:0,0.3:0.1,1:0.8"), StyleValue(ramp));
    EXPECT_EQ(parseStyleText(opacity, "[[0,0],[0.3,0.1],[1,0.8]]"), StyleValue(ramp));
    for (const char* text : {"0:0,0.3", "0:0:0", "0:0,,1:1", "0.5:0,0.4:1", "0:2", "-0.1:0", "1.1:0", "[[0]]",
                             "[0,1]", "[[0,0]"})
        EXPECT_THROW((void)parseStyleText(opacity, text), InvalidInput) << text;
    EXPECT_NO_THROW((void)parseStyleText(opacity, "0.5:0,0.5:1")) << "a step";

    const KeySpec& colours = testKeys().at("transfer.points");
    EXPECT_EQ(parseStyleText(colours, "0:#000000,1:#ffffff"),
              StyleValue(ColourStops{{0.0, Colour{{0, 0, 0, 255}}}, {1.0, Colour{{255, 255, 255, 255}}}}));
    for (const char* text : {"0:#00000080", "0:0", "0:red", "2:#000000"})
        EXPECT_THROW((void)parseStyleText(colours, text), InvalidInput) << text;
    json many = json::array();
    for (int i = 0; i < 257; ++i)
        many.push_back(json::array({i / 256.0, 0.5}));
    EXPECT_THROW((void)parseStyleValue(opacity, many), InvalidInput);
}

TEST(StyleKeys, RowsOfNumbersFromJsonAndText) {
    const KeySpec& planes = testKeys().at("clip.planes");
    const NumberTable two{{{1, 0, 0, 0.5}, {0, 0, -1, -0.25}}};
    EXPECT_EQ(parseStyleText(planes, "1,0,0,0.5;0,0,-1,-0.25"), StyleValue(two));
    EXPECT_EQ(parseStyleText(planes, "1, 0, 0, 0.5; 0, 0, -1, -0.25"), StyleValue(two));
    EXPECT_EQ(parseStyleValue(planes, json::parse("[[1,0,0,0.5],[0,0,-1,-0.25]]")), StyleValue(two));
    EXPECT_EQ(parseStyleText(planes, styleValueText(two)), StyleValue(two));
    EXPECT_EQ(parseStyleValue(planes, styleValueToJson(two)), StyleValue(two));
    const NumberTable one{{{0, 1, 0, 0.5}}};
    EXPECT_EQ(parseStyleValue(planes, json::array({0, 1, 0, 0.5})), StyleValue(one))
        << "a single row may be flat";
    EXPECT_EQ(parseStyleValue(planes, styleValueToJson(one)), StyleValue(one));
    EXPECT_EQ(parseStyleText(planes, "none"), StyleValue(None{}));
    for (const char* text :
         {"1,0,0", "1,0,0,0.5,2", "1,0,0,x", "1,0,0,0.5;", ";", ",,,", "[[1,0,0,0.5],[1,0,0]]"})
        EXPECT_THROW((void)parseStyleText(planes, text), InvalidInput) << text;
    const Error error = caught<InvalidInput>([&] { (void)parseStyleText(planes, "1,0,0"); });
    EXPECT_NE(error.toDo().find("[nx, ny, nz, position]"), std::string::npos) << error.toDo();

    const KeySpec& isovalue = testKeys().at("isovalue");
    EXPECT_EQ(parseStyleText(isovalue, "0.25,-3"), StyleValue(NumberTable{{{0.25}, {-3.0}}}));
    EXPECT_EQ(parseStyleValue(isovalue, 7), StyleValue(NumberTable{{{7.0}}}));
    EXPECT_EQ(styleValueToJson(NumberTable{{{0.25}, {-3.0}}}), json::array({0.25, -3.0}));
    EXPECT_EQ(parseStyleText(isovalue, "auto"), StyleValue(Automatic{}));
}

TEST(StyleKeys, ListsOfColours) {
    const KeySpec& colours = testKeys().at("isosurface.colors");
    const ColourList two{Colour{{255, 0, 0, 255}}, Colour{{0, 0, 255, 255}}};
    EXPECT_EQ(parseStyleText(colours, "#ff0000,#0000ff"), StyleValue(two));
    EXPECT_EQ(parseStyleValue(colours, json::array({"#ff0000", "#0000ff"})), StyleValue(two));
    EXPECT_EQ(parseStyleText(colours, styleValueText(two)), StyleValue(two));
    for (const char* text : {"red", "#ff0000,", "#ff000080", "transparent"})
        EXPECT_THROW((void)parseStyleText(colours, text), InvalidInput) << text;
}

TEST(StyleKeys, TextsAreKeptAsTheyAre) {
    const KeySpec& shape = testKeys().at("clip.shape");
    EXPECT_EQ(parseStyleText(shape, "B1 > 0.4"), StyleValue(std::string("B1 > 0.4")));
    EXPECT_EQ(parseStyleText(shape, "none"), StyleValue(None{}));
    for (const std::string& text : {std::string("a\nb"), std::string("\xff\xfe"), std::string(201, 'x')})
        EXPECT_THROW((void)parseStyleText(shape, text), InvalidInput) << text;
}

TEST(StyleKeys, IntegersTakeWholeNumbersOnly) {
    const KeySpec& time = testKeys().at("time");
    EXPECT_EQ(parseStyleValue(time, 3), StyleValue(std::int64_t{3}));
    EXPECT_EQ(parseStyleValue(time, 3.0), StyleValue(std::int64_t{3}));
    EXPECT_THROW((void)parseStyleValue(time, 3.5), InvalidInput);
    EXPECT_THROW((void)parseStyleValue(time, std::numeric_limits<std::uint64_t>::max()), InvalidInput);
    EXPECT_THROW((void)parseStyleValue(time, 1e300), InvalidInput);
}

TEST(StyleKeys, FieldsByNameOrIndex) {
    const KeySpec& field = testKeys().at("field");
    EXPECT_EQ(parseStyleText(field, "2"), StyleValue(std::int64_t{2}));
    EXPECT_EQ(parseStyleText(field, "charge density"), StyleValue(std::string("charge density")));
    EXPECT_EQ(parseStyleValue(field, "2"), StyleValue(std::string("2"))) << "JSON tells them apart";
    EXPECT_THROW((void)parseStyleText(field, "99999"), InvalidInput);
    EXPECT_THROW((void)parseStyleValue(field, -1), InvalidInput);
    EXPECT_THROW((void)parseStyleText(field, "a\nb"), InvalidInput);
    EXPECT_THROW((void)parseStyleText(field, "\xff\xfe"), InvalidInput);
    EXPECT_THROW((void)parseStyleText(field, std::string(201, 'x')), InvalidInput);
}

TEST(StyleKeys, PatchesSetAndReset) {
    const StylePatch patch = parseStylePatch(testKeys(), json{{"camera.fov", 40}, {"technique", nullptr}});
    EXPECT_EQ(patch.at("camera.fov"), std::optional<StyleValue>(40.0));
    EXPECT_FALSE(patch.at("technique").has_value());
    EXPECT_EQ(caught<InvalidInput>([] { (void)parseStylePatch(testKeys(), json::array()); }).field(),
              "style");
    EXPECT_EQ(caught<InvalidInput>([] {
                  (void)parseStylePatch(testKeys(), json{{"camera", json::object()}});
              }).field(),
              "camera");
    EXPECT_THROW((void)parseStyleMap(testKeys(), json{{"technique", nullptr}}), InvalidInput)
        << "a layer holds no resets";
}

TEST(StyleKeys, AssignmentsAsOnTheCommandLine) {
    EXPECT_EQ(parseAssignment(testKeys(), "camera.fov=40").second, std::optional<StyleValue>(40.0));
    EXPECT_EQ(parseAssignment(testKeys(), "camera.target=1,-2,0.5").second,
              std::optional<StyleValue>(glm::dvec3(1, -2, 0.5)));
    EXPECT_FALSE(parseAssignment(testKeys(), "camera.fov=").second.has_value());
    EXPECT_FALSE(parseAssignment(testKeys(), "camera.fov=null").second.has_value());
    EXPECT_EQ(parseAssignment(testKeys(), "field=a=b").second, std::optional<StyleValue>(std::string("a=b")));
    EXPECT_THROW((void)parseAssignment(testKeys(), "camera.fov"), InvalidInput);
    EXPECT_THROW((void)parseAssignment(testKeys(), "=3"), InvalidInput);
}

TEST(StyleKeys, DescriptionHoldsWhatThePageNeeds) {
    const json list = describeKeys(testKeys());
    ASSERT_EQ(list.size(), testKeys().keys().size());
    for (const json& item : list) {
        const KeySpec& key = testKeys().at(item.at("name").get<std::string>());
        EXPECT_EQ(item.at("type"), keyTypeName(key.type));
        EXPECT_EQ(parseStyleValue(key, item.at("default")), key.defaultValue);
        EXPECT_EQ(item.contains("choices"), key.type == KeyType::Choice);
        if (item.contains("appliesWhen")) {
            const KeySpec& other = testKeys().at(item["appliesWhen"].at("key").get<std::string>());
            for (const json& value : item["appliesWhen"].at("values"))
                EXPECT_NO_THROW((void)parseStyleValue(other, value)) << "the condition can come true";
        }
    }
}

} // namespace
} // namespace voxsheet::sheet
