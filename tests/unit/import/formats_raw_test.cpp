#include "formats_fixture.h"

namespace voxsheet::import::testing {
namespace {

class FormatsRaw : public FormatsTest {};

TEST_F(FormatsRaw, ReadsWithASidecar) {
    const auto values = ramp<short>(24);
    write("a.raw", bytesOf(values, true));
    write("a.json",
          R"({"dims": [2, 3, 4], "type": "i16", "endian": "big", "spacing": [1, 2, 3], "origin": [4, 5, 6],
                        "direction": [0, 1, 0, 1, 0, 0, 0, 0, 1], "periodic": [true, false, false], "units": "nm",
                        "fields": ["pressure"], "centring": "cell", "value_scale": 0.5, "spacng": 1})");
    for (const auto* opened : {"a.raw", "a.json"}) {
        const auto loaded = load(folder_ / opened);
        EXPECT_EQ(loaded.values<short>(), values);
        const auto& meta = loaded.meta();
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[0]), glm::dvec3(0, 1, 0));
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[1]), glm::dvec3(2, 0, 0));
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), glm::dvec3(4, 5, 6));
        EXPECT_EQ(meta.grid.periodic, glm::bvec3(true, false, false));
        EXPECT_EQ(meta.grid.centring, Centring::Cell);
        EXPECT_EQ(meta.fields[0].name, "pressure");
        EXPECT_EQ(meta.fields[0].valueScale, 0.5);
        EXPECT_EQ(meta.lengthUnit, "nm");
        ASSERT_EQ(meta.notes.size(), 1U);
        expectMentions(meta.notes[0], "spacng");
        EXPECT_EQ(loaded.header.files.size(), 2U);
    }
}

TEST_F(FormatsRaw, ReadsComponentsAndSteps) {
    const auto values = ramp<float>(2 * 2 * 2 * 3 * 2);
    write("a.dat", "SKIP" + bytesOf(values));
    const auto loaded =
        load(write("b.json", R"({"dims": [2, 2, 2], "type": "float32", "file": "a.dat", "skip": 4,
                                                "components": 3, "steps": 2, "times": [0.5, 0.75]})"));
    EXPECT_EQ(loaded.meta().times, (std::vector<double>{0.5, 0.75}));
    EXPECT_EQ(loaded.values<float>(2, 1)[3], values[24 + 3 * 3 + 2]);
}

TEST_F(FormatsRaw, ReadsByOptions) {
    const auto values = ramp<unsigned short>(24);
    ImportOptions options;
    options.rawDims = glm::ivec3(2, 3, 4);
    options.rawType = ScalarType::U16;
    options.rawSkipBytes = 3;
    const auto path = write("scan.bin", "abc" + bytesOf(values));
    EXPECT_EQ(load(path, options).values<unsigned short>(), values);
    options.rawDims = glm::ivec3(2, 3, 5);
    expectMentions(loadError(path, options), "60 bytes");
    options.rawDims = glm::ivec3(2, -3, 5);
    expectMentions(loadError(path, options), "-3");
    options.rawDims = glm::ivec3(2, 3, 4);
    options.rawComponents = 0;
    EXPECT_FALSE(loadError(path, options).empty());
    options.rawComponents = 1;
    options.rawSkipBytes = ~0ULL;
    EXPECT_FALSE(loadError(path, options).empty());
}

TEST_F(FormatsRaw, SaysWhatIsMissing) {
    const auto path = write("scan.raw", "voxels");
    expectMentions(loadError(path), "scan.json");
    write("scan.mhd", "NDims = 3\n");
    expectMentions(loadError(path), "scan.mhd");
}

TEST_F(FormatsRaw, RefusesWrongSidecars) {
    write("a.raw", std::string(24, 'v'));
    const auto message = [&](const std::string& text) { return loadError(write("a.json", text)); };
    ASSERT_NO_THROW((void)load(write("a.json", R"({"dims": [2, 3, 4], "type": "u8"})")));
    for (const std::string members :
         {R"("dims": [2, 3])", R"("dims": [2, 3, 4.5])", R"("dims": [2, 3, -4])",
          R"("dims": [2, 3, 18446744073709551615])", R"("dims": "2 3 4")",
          R"("dims": [2000000000, 2000000000, 2000000000])", R"("type": "u8", "dims": [2, 3, 5])"})
        EXPECT_FALSE(message("{\"type\": \"u8\", " + members + "}").empty()) << members;
    for (const std::string member :
         {R"("spacing": [1, 0, 1])", R"("spacing": [1, 1e999, 1])", R"("spacing": null)", R"("file": "../x")",
          R"("file": "/etc/passwd")", R"("endian": "middle")", R"("skip": -1)", R"("skip": 1)",
          R"("components": 0)", R"("steps": -1)", R"("fields": ["a", "b"])", R"("times": [1, 2])",
          R"("periodic": [1, 0, 0])", R"("direction": [1, 0, 0, 1, 0, 0, 0, 0, 1])", R"("value_scale": 0)",
          R"("centring": "middle")", R"("units": 5)", R"("anatomical": "yes")"})
        EXPECT_FALSE(message("{\"dims\": [2, 3, 4], \"type\": \"u8\", " + member + "}").empty()) << member;
    EXPECT_FALSE(message(R"({"dims": [2, 3, 4], "type": "u7"})").empty());
    EXPECT_FALSE(message(R"({"dims": [2, 3, 4], "type": "u8")").empty());
    std::string deep = R"({"dims": [2, 3, 4], "type": "u8", "x": )";
    EXPECT_FALSE(message(deep + std::string(100'000, '[')).empty());
    EXPECT_FALSE(message(deep + std::string(100, '[') + std::string(100, ']') + "}").empty());
}

} // namespace
} // namespace voxsheet::import::testing
