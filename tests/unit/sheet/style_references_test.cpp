#include "sheet/style_references.h"

#include "sheet/clip_shape.h"
#include "sheet_fixture.h"

namespace voxsheet::sheet {
namespace {

Workbook after(const Workbook& workbook, const Command& command) {
    return apply(workbook, command, testKeys());
}

std::string textOf(const StyleMap& style, const std::string& key) {
    return std::get<std::string>(style.at(key));
}

/// Names in the styles of the sheet, a column, a row, a cell, and of another sheet.
Workbook namingWorkbook() {
    Workbook workbook = filledWorkbook(3, 2);
    Sheet& sheet = workbook.sheets.front();
    sheet.style["clip.shape"] = std::string(" b1 > 0.4");
    sheet.columnHeaders[1].style["layers"] = std::string("A1; 'd1; B1' ;Sheet1!B1");
    sheet.rowHeaders[1].style["isosurface.colorBy"] = std::string("B1");
    sheet.rowHeaders[1].style["overlay.dataset"] = std::string("B1");
    sheet.cells[{0, 0}].style["clip.shape"] = std::string("'d2' <= -1");
    Sheet other;
    other.name = "Other";
    other.columns = 3;
    other.style["clip.shape"] = std::string("Sheet1!B1 >= 2");
    other.columnHeaders[0].style["isosurface.colorBy"] = std::string("B1");
    workbook.sheets.push_back(other);
    return workbook;
}

TEST(StyleReferences, FollowAMovedCellFromEveryLayer) {
    const auto moved = after(namingWorkbook(), MoveCells{"Sheet1", parseRange("B1"), parseAddress("C4")});
    const Sheet& sheet = moved.sheets[0];
    EXPECT_EQ(textOf(sheet.style, "clip.shape"), " C4 > 0.4");
    EXPECT_EQ(textOf(sheet.columnHeaders.at(1).style, "layers"), "A1; 'd1; B1' ;Sheet1!C4");
    EXPECT_EQ(textOf(sheet.rowHeaders.at(1).style, "isosurface.colorBy"), "C4");
    EXPECT_EQ(textOf(sheet.rowHeaders.at(1).style, "overlay.dataset"), "C4");
    EXPECT_EQ(textOf(sheet.cells.at({0, 0}).style, "clip.shape"), "'d2' <= -1");
    EXPECT_EQ(textOf(moved.sheets[1].style, "clip.shape"), "Sheet1!C4 >= 2");
    EXPECT_EQ(textOf(moved.sheets[1].columnHeaders.at(0).style, "isosurface.colorBy"), "B1")
        << "its own B1 did not move";
}

TEST(StyleReferences, FollowInsertedColumnsSwapsAndLayouts) {
    const auto inserted = after(namingWorkbook(), InsertLines{"Sheet1", Axis::Columns, 1, 2});
    EXPECT_EQ(textOf(inserted.sheets[0].style, "clip.shape"), " D1 > 0.4");
    const auto swapped = after(namingWorkbook(), SwapCells{"Sheet1", parseAddress("B1"), parseAddress("A2")});
    EXPECT_EQ(textOf(swapped.sheets[0].style, "clip.shape"), " A2 > 0.4");
    const auto laidOut = after(namingWorkbook(), SetLayout{"Sheet1", 1});
    EXPECT_EQ(textOf(laidOut.sheets[0].style, "clip.shape"), " A2 > 0.4");
}

TEST(StyleReferences, ACellThatIsGoneIsNamedAsSuch) {
    const auto deleted = after(namingWorkbook(), DeleteLines{"Sheet1", Axis::Columns, 1, 1});
    const auto text = textOf(deleted.sheets[0].style, "clip.shape");
    EXPECT_EQ(text, " #REF! > 0.4");
    const auto error = caught<InvalidInput>([&] { (void)parseClipShape(text); });
    EXPECT_NE(std::string(error.what()).find("gone"), std::string::npos) << error.what();
    EXPECT_EQ(error.field(), "clip.shape");
    const auto without = after(namingWorkbook(), DeleteSheet{"Sheet1"});
    EXPECT_EQ(textOf(without.sheets[0].style, "clip.shape"), "#REF! >= 2");
}

TEST(StyleReferences, FollowNewNamesOfSheetsAndDatasets) {
    const auto sheet = after(namingWorkbook(), RenameSheet{"Sheet1", "Before and after"});
    EXPECT_EQ(textOf(sheet.sheets[1].style, "clip.shape"), "'Before and after'!B1 >= 2");
    EXPECT_EQ(textOf(sheet.sheets[0].style, "clip.shape"), " b1 > 0.4");
    const auto dataset = after(namingWorkbook(), RenameDataset{"d2", "run 2"});
    EXPECT_EQ(textOf(dataset.sheets[0].cells.at({0, 0}).style, "clip.shape"), "'run 2' <= -1");
}

TEST(StyleReferences, AShapeIsNoDatasetOfThatName) {
    StyleMap style{{"clip.shape", std::string("sphere")}};
    renameDatasetInStyle(style, "sphere", "ball");
    EXPECT_EQ(textOf(style, "clip.shape"), "sphere");
    style["clip.shape"] = std::string("'sphere'");
    renameDatasetInStyle(style, "sphere", "ball");
    EXPECT_EQ(textOf(style, "clip.shape"), "'ball'");
    style["clip.shape"] = std::string("a; b");
    renameDatasetInStyle(style, "a; b", "mesh");
    EXPECT_EQ(textOf(style, "clip.shape"), "'mesh'");
}

} // namespace
} // namespace voxsheet::sheet
