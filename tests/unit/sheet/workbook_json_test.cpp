#include "sheet/workbook_json.h"

#include "sheet/bounded_json.h"
#include "sheet_fixture.h"

#include <nlohmann/json.hpp>

#include <random>

namespace voxsheet::sheet {
namespace {

using nlohmann::json;

Workbook richWorkbook() {
    Workbook book = filledWorkbook(3, 2);
    book.title = "Vacancies in MgSiO₃ \"perovskite\"";
    book.datasets["d1"].options = R"({"dims":[4,4,4],"type":"u8"})";
    book.datasets["d2"].checksum = "xxh3:00ff";
    Sheet& sheet = book.sheets[0];
    sheet.title = "first";
    sheet.autoLayout = false;
    sheet.levels = LevelSettings{LevelPolicy::Rate, 250.0, 1.0 / 3.0, 9, std::uint64_t{3} << 40, 0.6};
    sheet.style = {{"camera.target", glm::dvec3(0.1, -1.0 / 3.0, 1e-300)},
                   {"transfer.opacity", OpacityStops{{0.0, 0.0}, {0.1, 1.0 / 7.0}, {1.0, 1.0}}},
                   {"transfer.points", ColourStops{{0.0, Colour{{1, 2, 3, 255}}}}}};
    sheet.columnHeaders[2] = {"third", {{"technique", std::string("mip")}}};
    sheet.rowHeaders[1] = {"", {{"transfer.belowColor", None{}}, {"transfer.unitLength", Automatic{}}}};
    sheet.cells[{1, 1}] = {"=B1-A1", "difference", {{"range.min", -1.5}, {"time", std::int64_t{3}}}};
    sheet.cells.erase({2, 1});
    book.sheets.push_back(Sheet{});
    book.sheets[1].name = "My sheet";
    return book;
}

std::string fieldOf(const std::string& text) {
    return caught<InvalidInput>([&] { (void)parseWorkbook(text, testKeys()); }).field();
}

TEST(WorkbookJson, RoundTripIsExact) {
    const Workbook book = richWorkbook();
    const std::string text = serialiseWorkbook(book);
    EXPECT_EQ(parseWorkbook(text, testKeys()), book);
    EXPECT_EQ(serialiseWorkbook(parseWorkbook(text, testKeys())), text);
    EXPECT_EQ(parseWorkbook(serialiseWorkbook(Workbook{}), testKeys()), Workbook{});
    EXPECT_TRUE(text.ends_with("}\n"));
    EXPECT_TRUE(text.starts_with("{\n  \"voxsheet\": 1")) << "says first what it is";
}

TEST(WorkbookJson, LayersAndTheirWeightsSurviveOnEveryStyleLayer) {
    Workbook book = filledWorkbook(3, 2);
    Sheet& sheet = book.sheets[0];
    const auto fused = [](const std::string& layers, const NumberTable& weights) {
        return StyleMap{{"layers", layers}, {"layers.weights", weights}};
    };
    sheet.style = fused("B1", NumberTable{{{1.0}, {1.0 / 3.0}}});
    sheet.columnHeaders[1] = {"", {{"layers", None{}}}};
    sheet.rowHeaders[1] = {"", fused("A1; Other!B2", NumberTable{{{0.1}, {0.0}, {1.0}}})};
    sheet.cells.at({0, 0}).style = fused("d2; A2; 'run; 3'", NumberTable{{{0.25}, {0.5}, {0.75}, {1e-9}}});
    const Workbook read = parseWorkbook(serialiseWorkbook(book), testKeys());
    EXPECT_EQ(read, book);
    EXPECT_EQ(read.sheets[0].cells.at({0, 0}).style.at("layers.weights"),
              StyleValue(NumberTable{{{0.25}, {0.5}, {0.75}, {1e-9}}}));
    EXPECT_EQ(resolveStyle(testKeys(), read.sheets[0], {0, 1}).style.layers.weights,
              (std::vector<double>{0.1, 0.0, 1.0}));
    EXPECT_EQ(resolveStyle(testKeys(), read.sheets[0], {1, 0}).style.layers.volumes, "");
}

TEST(WorkbookJson, LevelsThatSayLittleHaveTheDefaultsOtherwise) {
    const auto read = parseWorkbook(
        R"({"voxsheet":1,"sheets":[{"name":"S","columns":1,"rows":1,"levels":{"policy":"slope"}}]})",
        testKeys());
    EXPECT_EQ(read.sheets[0].levels, (LevelSettings{.policy = LevelPolicy::Slope}));
    EXPECT_FALSE(parseWorkbook(R"({"voxsheet":1,"sheets":[{"name":"S","columns":1,"rows":1}]})", testKeys())
                     .sheets[0]
                     .levels);
}

TEST(WorkbookJson, EveryKeysDefaultSurvives) {
    Workbook book = filledWorkbook(1, 1);
    for (const KeySpec& key : testKeys().keys())
        book.sheets[0].style[key.name] = key.defaultValue;
    EXPECT_EQ(parseWorkbook(serialiseWorkbook(book), testKeys()), book);
}

TEST(WorkbookJson, ErrorsNameTheMember) {
    const auto document = [](const std::string& sheet) {
        return R"({"voxsheet":1,"datasets":{"d1":{"files":["a"]}},"sheets":[{"name":"S","columns":2,"rows":2,)" +
               sheet + "}]}";
    };
    EXPECT_NO_THROW((void)parseWorkbook(document(R"("title":"t")"), testKeys()));
    EXPECT_EQ(fieldOf(document(R"("cells":{"A1":{"style":{"camera.fov":999}}})")),
              "sheets[0].cells.A1.style.camera.fov");
    EXPECT_EQ(fieldOf(document(R"("cells":{"A1":{"sorce":"d1"}})")), "sheets[0].cells.A1.sorce");
    EXPECT_EQ(fieldOf(document(R"("cells":{"A1":{"source":3}})")), "sheets[0].cells.A1.source");
    EXPECT_EQ(fieldOf(document(R"("cells":{"A1":{"source":"d9"}})")), "sheets[0].cells.A1.source");
    EXPECT_EQ(fieldOf(document(R"("cells":{"C1":{"source":"d1"}})")), "sheets[0].cells.C1");
    EXPECT_EQ(fieldOf(document(R"("cells":{"1A":{"source":"d1"}})")), "sheets[0].cells.1A");
    EXPECT_EQ(fieldOf(document(R"("cells":{"A1":{"source":"d1"},"a1":{"source":"d1"}})")),
              "sheets[0].cells.a1");
    EXPECT_EQ(fieldOf(document(R"("style":[])")), "sheets[0].style");
    EXPECT_EQ(fieldOf(document(R"("levels":"slope")")), "sheets[0].levels");
    EXPECT_EQ(fieldOf(document(R"("levels":{"policy":"steep"})")), "sheets[0].levels.policy");
    EXPECT_EQ(fieldOf(document(R"("levels":{"frame_ms":0})")), "sheets[0].levels.frame_ms");
    EXPECT_EQ(fieldOf(document(R"("levels":{"frame_ms":"fast"})")), "sheets[0].levels.frame_ms");
    EXPECT_EQ(fieldOf(document(R"("levels":{"datasets":1.5})")), "sheets[0].levels.datasets");
    EXPECT_EQ(fieldOf(document(R"("levels":{"bytes":-1})")), "sheets[0].levels.bytes");
    EXPECT_EQ(fieldOf(document(R"("levels":{"up_fraction":1.01})")), "sheets[0].levels.up_fraction");
    EXPECT_EQ(fieldOf(document(R"("levels":{"frame":1})")), "sheets[0].levels.frame");
    EXPECT_EQ(fieldOf(document(R"("rowHeaders":{"3":{"title":"x"}})")), "sheets[0].rowHeaders.3");
    EXPECT_EQ(fieldOf(document(R"("columnHeaders":{"A":{"title":"x\u0000"}})")),
              "sheets[0].columnHeaders.A.title");
    EXPECT_EQ(fieldOf(R"({"voxsheet":1})"), "sheets");
    EXPECT_EQ(fieldOf(R"({"voxsheet":1,"sheets":[]})"), "sheets");
    EXPECT_EQ(fieldOf(R"({"sheets":[]})"), "voxsheet");
    EXPECT_EQ(fieldOf(R"({"voxsheet":0,"sheets":[]})"), "voxsheet");
    EXPECT_EQ(fieldOf(R"({"voxsheet":"1","sheets":[]})"), "voxsheet");
    EXPECT_EQ(fieldOf(R"({"voxsheet":1,"sheets":{}})"), "sheets");
    EXPECT_EQ(fieldOf(R"({"voxsheet":1,"sheets":[{"name":"S","columns":0,"rows":1}]})"), "sheets[0].columns");
    EXPECT_EQ(fieldOf(R"({"voxsheet":1,"sheets":[{"name":"S","columns":1024,"rows":1024}]})"), "sheets[0]");
    EXPECT_EQ(fieldOf(R"({"voxsheet":1,"sheets":[{"name":"S","columns":1.5,"rows":1}]})"),
              "sheets[0].columns");
    EXPECT_EQ(
        fieldOf(
            R"({"voxsheet":1,"datasets":{"d":{"files":[]}},"sheets":[{"name":"S","columns":1,"rows":1}]})"),
        "datasets.d.files");
    EXPECT_EQ(
        fieldOf(
            R"({"voxsheet":1,"sheets":[{"name":"S","columns":1,"rows":1},{"name":"s","columns":1,"rows":1}]})"),
        "sheets[1].name");
    EXPECT_EQ(fieldOf("[]"), "document");
    EXPECT_NE(std::string(caught<InvalidInput>([&] {
                              (void)parseWorkbook(document(R"("cels":{})"), testKeys());
                          }).what())
                  .find("did you mean \"cells\""),
              std::string::npos);
    EXPECT_THROW((void)parseWorkbook(R"({"voxsheet":2,"sheets":[]})", testKeys()), Unsupported);
}

TEST(BoundedJson, DepthSizeDuplicatesAndBadText) {
    EXPECT_EQ(parseBoundedJson("[1,{\"a\":2}]", "x"), json::parse("[1,{\"a\":2}]"));
    for (const char* piece : {"[", "{\"a\":", "[[{\"a\":"}) {
        std::string deep;
        for (int i = 0; i < 100000; ++i)
            deep += piece;
        EXPECT_THROW((void)parseBoundedJson(deep, "x"), InvalidInput) << piece;
    }
    const std::string just = std::string(32, '[') + std::string(32, ']');
    EXPECT_NO_THROW((void)parseBoundedJson(just, "x"));
    EXPECT_THROW((void)parseBoundedJson("[" + just + "]", "x"), InvalidInput);
    EXPECT_EQ(
        caught<InvalidInput>([] { (void)parseBoundedJson(R"({"a":1,"b":{"a":2},"a":3})", "x"); }).field(),
        "a");
    EXPECT_THROW((void)parseBoundedJson("[1,2]", "x", {3, 8}), LimitExceeded);
    for (const char* text :
         {"", "{", "[1,]", "nul", "1e999", "\"\xff\"", "{\"a\":NaN}", "[1] 2", "'a'", "\"\\ud800\""})
        EXPECT_THROW((void)parseBoundedJson(text, "x"), InvalidInput) << text;
    EXPECT_EQ(std::string(caught<InvalidInput>([] { (void)parseBoundedJson("[1,]", "the body"); }).what())
                  .find("the body"),
              0U);
}

TEST(WorkbookJson, DamagedTextIsRefusedOrReadsAsAValidWorkbook) {
    const std::string good = serialiseWorkbook(richWorkbook());
    std::mt19937 random(5);
    int refused = 0;
    int read = 0;
    for (int i = 0; i < 800; ++i) {
        std::string text = good;
        for (auto n = 1 + random() % 3; n > 0; --n) {
            const std::size_t at = random() % text.size();
            switch (random() % 5) {
            case 0:
                text[at] = static_cast<char>(random() % 256);
                break;
            case 1:
                text.erase(at, 1 + random() % 20);
                break;
            case 2:
                text.insert(at, 1, "{}[]\",:0-9e.nA"[random() % 14]);
                break;
            case 3:
                text.insert(at, text.substr(random() % text.size(), random() % 40));
                break;
            default:
                text.resize(at + 1);
                break;
            }
        }
        try {
            const Workbook book = parseWorkbook(text, testKeys());
            validateWorkbook(book);
            EXPECT_EQ(parseWorkbook(serialiseWorkbook(book), testKeys()), book);
            (void)evaluateWorkbook(testKeys(), book, allReady(2));
            ++read;
        } catch (const Error& error) {
            EXPECT_FALSE(error.why().empty());
            ++refused;
        }
    }
    EXPECT_GT(refused, 250);
    EXPECT_GT(read, 10);
}

TEST(WorkbookJson, MembersOfTheWrongTypeAreRefusedEverywhere) {
    const json good = json(workbookToJson(richWorkbook()));
    const json flat = good.flatten();
    int tried = 0;
    for (const auto& [pointer, value] : flat.items()) {
        for (const json& wrong :
             {json(nullptr), json(json::array({json::object()})), json(-7), json("?\n")}) {
            if (wrong == value) continue;
            json damaged = good;
            damaged[json::json_pointer(pointer)] = wrong;
            ++tried;
            try {
                validateWorkbook(workbookFromJson(damaged, testKeys()));
            } catch (const Error& error) {
                EXPECT_FALSE(error.field().empty()) << pointer << ": " << error.what();
            }
        }
    }
    EXPECT_GT(tried, 100);
}

} // namespace
} // namespace voxsheet::sheet
