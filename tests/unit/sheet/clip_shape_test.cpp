#include "sheet/clip_shape.h"

#include "sheet_fixture.h"

namespace voxsheet::sheet {
namespace {

TEST(ClipShape, NamesOfShapes) {
    for (const char* name : {"sphere", "ellipsoid", "box", "cylinder", "torus"})
        EXPECT_EQ(parseClipShape(name), ClipShape(AnalyticShape{name}));
    EXPECT_EQ(parseClipShape(" Torus "), ClipShape(AnalyticShape{"torus"}));
}

TEST(ClipShape, NamesOfDatasets) {
    EXPECT_EQ(parseClipShape("femur.stl"), ClipShape(DatasetShape{"femur.stl"}));
    EXPECT_EQ(parseClipShape("'box'"), ClipShape(DatasetShape{"box"}))
        << "quotes tell a dataset from a shape";
    EXPECT_EQ(parseClipShape("'a > b'"), ClipShape(DatasetShape{"a > b"}));
}

TEST(ClipShape, Comparisons) {
    const SheetAddress b1{"", {1, 0}};
    EXPECT_EQ(parseClipShape("B1 > 0.4"), ClipShape(ComparisonShape{b1, Comparison::Greater, 0.4}));
    EXPECT_EQ(parseClipShape("b1>=-1e3"),
              ClipShape(ComparisonShape{b1, Comparison::GreaterOrEqual, -1000.0}));
    EXPECT_EQ(parseClipShape("Sheet2!C4 < 7"),
              ClipShape(ComparisonShape{SheetAddress{"Sheet2", {2, 3}}, Comparison::Less, 7.0}));
    EXPECT_EQ(parseClipShape("'My sheet'!A1 <= 0"),
              ClipShape(ComparisonShape{SheetAddress{"My sheet", {0, 0}}, Comparison::LessOrEqual, 0.0}));
    EXPECT_EQ(parseClipShape("'scan > 2' < -100"),
              ClipShape(ComparisonShape{std::string("scan > 2"), Comparison::Less, -100.0}));
    EXPECT_EQ(parseClipShape("density > 2"),
              ClipShape(ComparisonShape{std::string("density"), Comparison::Greater, 2.0}));
}

TEST(ClipShape, MistakesAreExplained) {
    for (const char* text : {"", "  ", "B1", "B1 >", "> 3", "B1 > x", "B1 > nan", "B1 > 1 > 2", "''",
                             "'' > 1", "ZZZ9999 > 1", "No!such!thing > 1"}) {
        const Error error = caught<InvalidInput>([&] { (void)parseClipShape(text); });
        EXPECT_EQ(error.field(), "clip.shape") << text;
        EXPECT_FALSE(error.toDo().empty()) << text;
    }
    EXPECT_NE(caught<InvalidInput>([] { (void)parseClipShape("B1"); }).toDo().find("B1 > 0.4"),
              std::string::npos);
}

TEST(ClipShape, NamesOfVolumes) {
    EXPECT_EQ(parseVolumeName("c3", "isosurface.colorBy"), VolumeName(SheetAddress{"", {2, 2}}));
    EXPECT_EQ(parseVolumeName("run 2", "isosurface.colorBy"), VolumeName(std::string("run 2")));
    EXPECT_EQ(parseVolumeName("'c3'", "isosurface.colorBy"), VolumeName(std::string("c3")));
    EXPECT_EQ(caught<InvalidInput>([] { (void)parseVolumeName(" ", "isosurface.colorBy"); }).field(),
              "isosurface.colorBy");
}

TEST(LayerNames, AreSeparatedBySemicolons) {
    EXPECT_EQ(parseLayers("b1"), (std::vector<VolumeName>{SheetAddress{"", {1, 0}}}));
    EXPECT_EQ(parseLayers(" B1; run 2 ;'a;b'"),
              (std::vector<VolumeName>{SheetAddress{"", {1, 0}}, std::string("run 2"), std::string("a;b")}));
    for (const char* text : {"", ";", "B1;", "B1;;C1", "A1;B1;C1;D1", "''"}) {
        const auto error = caught<InvalidInput>([&] { (void)parseLayers(text); });
        EXPECT_EQ(error.field(), "layers") << text;
        EXPECT_FALSE(error.toDo().empty()) << text;
    }
}

} // namespace
} // namespace voxsheet::sheet
