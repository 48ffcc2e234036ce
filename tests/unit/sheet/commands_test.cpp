#include "sheet/commands.h"

#include "sheet_fixture.h"

namespace voxsheet::sheet {
namespace {

Workbook after(const Workbook& workbook, const Command& command) {
    return apply(workbook, command, testKeys());
}

const Cell& cellAt(const Workbook& workbook, const char* address) {
    static const Cell blank;
    const Cell* cell = workbook.sheets[0].find(parseAddress(address));
    return cell ? *cell : blank;
}

Workbook withFormula(Workbook workbook, const char* address, const char* formula) {
    workbook.sheets[0].cells[parseAddress(address)].source = formula;
    return workbook;
}

StylePatch patch(const char* key, StyleValue value) { return {{key, std::move(value)}}; }

TEST(SetStyle, SetsAndResetsOnEveryLayer) {
    const Workbook start = filledWorkbook(2, 2);
    for (const Layer& layer : {Layer::sheet(), Layer::ofColumn(1), Layer::ofRow(0), Layer::ofCell({1, 1})}) {
        const Workbook set = after(start, SetStyle{"Sheet1", layer, patch("camera.fov", 44.0)});
        EXPECT_EQ(ownStyle(set.sheets[0], layer).at("camera.fov"), StyleValue(44.0));
        EXPECT_EQ(after(set, SetStyle{"sheet1", layer, {{"camera.fov", std::nullopt}}}), start)
            << layerName(layer);
    }
}

TEST(SetStyle, RefusesBadKeysValuesAndPlaces) {
    const Workbook start = filledWorkbook(2, 2);
    EXPECT_EQ(caught<InvalidInput>([&] {
                  (void)after(start, SetStyle{"Sheet1", Layer::sheet(), patch("no", 1.0)});
              }).field(),
              "no");
    EXPECT_THROW((void)after(start, SetStyle{"Sheet1", Layer::sheet(), patch("camera.fov", 0.0)}),
                 InvalidInput);
    EXPECT_THROW((void)after(start, SetStyle{"Sheet1", Layer::ofCell({2, 0}), patch("camera.fov", 40.0)}),
                 NotFound);
    EXPECT_THROW((void)after(start, SetStyle{"Nope", Layer::sheet(), patch("camera.fov", 40.0)}), NotFound);
    EXPECT_THROW(
        (void)after(start, SetStyle{"Sheet1", {LayerKind::PageView, 0, 0}, patch("camera.fov", 40.0)}),
        InvalidInput);
}

TEST(SetStyle, RefusesKeysThatWouldDisagreeInSomeCell) {
    Workbook start = filledWorkbook(2, 1);
    start.sheets[0].cells[{1, 0}].style["transfer.cut2"] = 0.5;
    const SetStyle edit{"Sheet1", Layer::sheet(), patch("transfer.cut1", 0.6)};
    EXPECT_EQ(caught<InvalidInput>([&] { (void)after(start, edit); }).field(), "transfer.cut1");
    start.sheets[0].cells[{1, 0}].style.clear();
    EXPECT_NO_THROW((void)after(start, edit));
}

TEST(SetStyle, ClearsWhatHidesTheEditWhenAsked) {
    Workbook start = filledWorkbook(2, 2);
    start.sheets[0].cells[{0, 0}].style["camera.fov"] = 50.0;
    start.sheets[0].rowHeaders[0].style["camera.fov"] = 51.0;
    start.sheets[0].columnHeaders[0].style["camera.fov"] = 52.0;
    start.sheets[0].columnHeaders[0].style["camera.roll"] = 5.0;
    SetStyle edit{"Sheet1", Layer::sheet(), patch("camera.fov", 44.0)};
    EXPECT_FALSE(hiddenBy(after(start, edit).sheets[0], Layer::sheet(), {"camera.fov"}).empty());
    edit.clearNearer = true;
    const Workbook cleared = after(start, edit);
    EXPECT_EQ(listOverrides(cleared.sheets[0]).size(), 1U) << "other keys stay";
    EXPECT_EQ(resolveStyle(testKeys(), cleared.sheets[0], {0, 0}).style.camera.fovDegrees, 44.0);
}

TEST(SetSource, TakesDatasetsFormulasAndNothing) {
    const Workbook start = filledWorkbook(2, 1);
    EXPECT_EQ(cellAt(after(start, SetSource{"Sheet1", {0, 0}, "d2"}), "A1").source, "d2");
    EXPECT_EQ(cellAt(after(start, SetSource{"Sheet1", {0, 0}, "=B1*"}), "A1").source, "=B1*")
        << "a broken formula is an error value, not a refused edit";
    EXPECT_EQ(after(start, SetSource{"Sheet1", {0, 0}, ""}).sheets[0].cells.size(), 1U);
    EXPECT_EQ(caught<NotFound>([&] {
                  (void)after(start, SetSource{"Sheet1", {0, 0}, "d9"});
              }).field(),
              "source");
    EXPECT_THROW((void)after(start, SetSource{"Sheet1", {0, 0}, "=" + std::string(kMaxFormulaBytes, '1')}),
                 InvalidInput);
}

TEST(SetTitle, OfEverything) {
    Workbook book = filledWorkbook(2, 1);
    book = after(book, SetTitle{"Sheet1", Layer::sheet(), "S"});
    book = after(book, SetTitle{"Sheet1", Layer::ofColumn(1), "C"});
    book = after(book, SetTitle{"Sheet1", Layer::ofRow(0), "R"});
    book = after(book, SetTitle{"Sheet1", Layer::ofCell({0, 0}), "A"});
    book = after(book, SetWorkbookTitle{"W"});
    EXPECT_EQ(book.sheets[0].title, "S");
    EXPECT_EQ(book.sheets[0].columnHeaders.at(1).title, "C");
    EXPECT_EQ(book.sheets[0].rowHeaders.at(0).title, "R");
    EXPECT_EQ(cellTitle(cellAt(book, "A1")), "A");
    EXPECT_EQ(cellTitle(cellAt(book, "B1")), "d2");
    EXPECT_EQ(book.title, "W");
    EXPECT_TRUE(after(book, SetTitle{"Sheet1", Layer::ofColumn(1), ""}).sheets[0].columnHeaders.empty());
    EXPECT_THROW((void)after(book, SetTitle{"Sheet1", Layer::sheet(), "a\nb"}), InvalidInput);
    EXPECT_THROW((void)after(book, SetTitle{"Sheet1", Layer::sheet(), "\xc3("}), InvalidInput);
}

TEST(SetLayout, ReflowsInReadingOrderAndFormulasFollow) {
    Workbook start = filledWorkbook(3, 2);
    start = withFormula(start, "C2", "=b1-A2 + A1");
    const Workbook two = after(start, SetLayout{"Sheet1", 2});
    EXPECT_EQ(two.sheets[0].columns, 2);
    EXPECT_EQ(two.sheets[0].rows, 3);
    EXPECT_EQ(cellAt(two, "A2").source, "d3");
    EXPECT_EQ(cellAt(two, "B3").source, "=b1-B2 + A1") << "what did not move keeps its spelling";
    EXPECT_THROW((void)after(start, SetLayout{"Sheet1", 0}), InvalidInput);
    EXPECT_THROW((void)after(start, SetLayout{"Sheet1", 5000}), InvalidInput);
    Workbook gap = filledWorkbook(3, 1);
    gap.sheets[0].cells.erase({1, 0});
    gap = withFormula(gap, "C1", "=A1+B1");
    EXPECT_EQ(cellAt(after(gap, SetLayout{"Sheet1", 1}), "A2").source, "=A1+#REF!")
        << "an empty cell has no new place";
}

TEST(Lines, InsertAndDeleteMoveEverything) {
    Workbook start = withFormula(filledWorkbook(3, 2), "C2", "=A1-B2");
    start.sheets[0].columnHeaders[1].title = "middle";
    const Workbook wider = after(start, InsertLines{"Sheet1", Axis::Columns, 1, 2});
    EXPECT_EQ(wider.sheets[0].columns, 5);
    EXPECT_EQ(cellAt(wider, "E2").source, "=A1-D2");
    EXPECT_EQ(wider.sheets[0].columnHeaders.at(3).title, "middle");
    EXPECT_EQ(after(wider, DeleteLines{"Sheet1", Axis::Columns, 1, 2}), start) << "one undoes the other";
    const Workbook narrower = after(start, DeleteLines{"Sheet1", Axis::Columns, 1, 1});
    EXPECT_EQ(cellAt(narrower, "B2").source, "=A1-#REF!");
    EXPECT_TRUE(narrower.sheets[0].columnHeaders.empty());
    EXPECT_EQ(cellAt(after(start, DeleteLines{"Sheet1", Axis::Rows, 0, 1}), "C1").source, "=#REF!-B1");
    EXPECT_THROW((void)after(start, DeleteLines{"Sheet1", Axis::Rows, 0, 2}), InvalidInput);
    EXPECT_THROW((void)after(start, DeleteLines{"Sheet1", Axis::Rows, 1, 2}), NotFound);
    EXPECT_THROW((void)after(start, DeleteLines{"Sheet1", Axis::Rows, -1, 1}), NotFound);
    EXPECT_THROW((void)after(start, InsertLines{"Sheet1", Axis::Rows, 3, 1}), NotFound);
    EXPECT_THROW((void)after(start, InsertLines{"Sheet1", Axis::Rows, 0, 2000000000}), LimitExceeded);
    EXPECT_THROW((void)after(start, InsertLines{"Sheet1", Axis::Rows, 0, 0}), LimitExceeded);
}

TEST(Lines, RangesThatAreCutKeepTheRest) {
    const Workbook start = withFormula(filledWorkbook(4, 2), "D2", "=abs(A1:C1)");
    EXPECT_EQ(cellAt(after(start, DeleteLines{"Sheet1", Axis::Columns, 1, 1}), "C2").source, "=abs(A1:B1)");
    EXPECT_EQ(cellAt(after(start, DeleteLines{"Sheet1", Axis::Columns, 2, 1}), "C2").source, "=abs(A1:B1)");
    EXPECT_EQ(cellAt(after(start, DeleteLines{"Sheet1", Axis::Columns, 0, 3}), "A2").source, "=abs(#REF!)");
}

TEST(MoveCells, FormulasFollowFromEverySheet) {
    Workbook start = withFormula(filledWorkbook(3, 2), "C2", "=A1+B1");
    start = after(start, AddSheet{"Other"});
    start.sheets[1].cells[{0, 0}].source = "=Sheet1!A1 - A1";
    const Workbook moved = after(start, MoveCells{"Sheet1", parseRange("A1"), parseAddress("A4")});
    EXPECT_EQ(moved.sheets[0].rows, 4) << "the sheet grows";
    EXPECT_EQ(cellAt(moved, "A4").source, "d1");
    EXPECT_TRUE(cellAt(moved, "A1").source.empty());
    EXPECT_EQ(cellAt(moved, "C2").source, "=A4+B1");
    EXPECT_EQ(moved.sheets[1].cells.at({0, 0}).source, "=Sheet1!A4 - A1") << "its own A1 did not move";
}

TEST(MoveCells, OverwrittenCellsBecomeBrokenReferences) {
    const Workbook start = withFormula(filledWorkbook(3, 2), "C2", "=A1+B1");
    const Workbook moved = after(start, MoveCells{"Sheet1", parseRange("A1"), parseAddress("B1")});
    EXPECT_EQ(cellAt(moved, "B1").source, "d1");
    EXPECT_EQ(cellAt(moved, "C2").source, "=B1+#REF!");
    const Workbook overlapping = after(start, MoveCells{"Sheet1", parseRange("A1:B1"), parseAddress("B1")});
    EXPECT_EQ(cellAt(overlapping, "B1").source, "d1");
    EXPECT_EQ(cellAt(overlapping, "C1").source, "d2");
    EXPECT_EQ(cellAt(overlapping, "C2").source, "=B1+C1");
    EXPECT_THROW((void)after(start, MoveCells{"Sheet1", parseRange("A1:B2"), {kMaxColumns - 1, 0}}),
                 LimitExceeded);
}

TEST(SwapCells, ExchangesEverything) {
    Workbook start = withFormula(filledWorkbook(3, 1), "C1", "=A1-B1");
    start.sheets[0].cells[{0, 0}].title = "first";
    const Workbook swapped = after(start, SwapCells{"Sheet1", {0, 0}, {1, 0}});
    EXPECT_EQ(cellAt(swapped, "B1").title, "first");
    EXPECT_EQ(cellAt(swapped, "C1").source, "=B1-A1") << "the value of C1 is the same";
    EXPECT_EQ(after(swapped, SwapCells{"Sheet1", {0, 0}, {1, 0}}), start);
    EXPECT_EQ(after(start, SwapCells{"Sheet1", {0, 0}, {0, 0}}), start);
}

TEST(ClearCells, EmptiesARange) {
    const Workbook cleared = after(filledWorkbook(3, 2), ClearCells{"Sheet1", parseRange("A1:B2")});
    EXPECT_EQ(cleared.sheets[0].cells.size(), 2U);
    EXPECT_THROW((void)after(filledWorkbook(3, 2), ClearCells{"Sheet1", parseRange("A1:D2")}), NotFound);
}

AddDatasets adding(std::vector<std::string> names) {
    AddDatasets command{
        .sheet = "Sheet1", .datasets = {}, .place = true, .columns = {}, .columnTitles = {}, .rowTitles = {}};
    for (std::string& name : names)
        command.datasets.push_back(
            {name, {.files = {"/x/" + name}, .bytes = 0, .checksum = "", .options = "{}"}, {}});
    return command;
}

TEST(AddDatasets, LaysOutAnEmptySheetNearSquare) {
    for (const auto& [n, columns, rows] : {std::tuple{1, 1, 1},
                                           {2, 2, 1},
                                           {3, 2, 2},
                                           {5, 3, 2},
                                           {9, 3, 3},
                                           {10, 4, 3},
                                           {25, 5, 5},
                                           {1000, 32, 32}}) {
        std::vector<std::string> names;
        for (int i = 0; i < n; ++i)
            names.push_back("n" + std::to_string(i));
        const Workbook book = after(Workbook{}, adding(names));
        EXPECT_EQ(book.sheets[0].columns, columns) << n;
        EXPECT_EQ(book.sheets[0].rows, rows) << n;
        EXPECT_EQ(book.sheets[0].cells.size(), static_cast<std::size_t>(n));
        EXPECT_EQ(book.sheets[0].cells.at({(n - 1) % columns, (n - 1) / columns}).source, names.back());
    }
}

TEST(AddDatasets, OneByOneStaysNearSquareAndMovesNothing) {
    Workbook book;
    std::map<std::string, Address> places;
    for (int i = 0; i < 30; ++i) {
        book = after(book, adding({"n" + std::to_string(i)}));
        for (const auto& [address, cell] : book.sheets[0].cells) {
            if (places.contains(cell.source)) {
                EXPECT_EQ(places.at(cell.source), address);
            }
            places[cell.source] = address;
        }
        EXPECT_LE(std::abs(book.sheets[0].columns - book.sheets[0].rows), 1);
        EXPECT_GE(book.sheets[0].columns, book.sheets[0].rows);
    }
}

TEST(AddDatasets, KeepsChosenColumns) {
    AddDatasets command = adding({"a", "b", "c", "d", "e"});
    command.columns = 2;
    Workbook book = after(Workbook{}, command);
    EXPECT_EQ(book.sheets[0].columns, 2);
    EXPECT_EQ(book.sheets[0].rows, 3);
    book = after(book, adding({"f", "g"}));
    EXPECT_EQ(book.sheets[0].columns, 2);
    EXPECT_EQ(cellAt(book, "B3").source, "f") << "gaps are filled first";
    EXPECT_EQ(cellAt(book, "A4").source, "g");
}

TEST(AddDatasets, PlacesTitlesAndConflicts) {
    AddDatasets command = adding({"a", "b"});
    command.datasets[0].place = parseAddress("C2");
    command.columnTitles = {"", "two", "three"};
    const Workbook book = after(Workbook{}, command);
    EXPECT_EQ(cellAt(book, "C2").source, "a");
    EXPECT_EQ(cellAt(book, "A1").source, "b");
    EXPECT_EQ(book.sheets[0].columnHeaders.at(2).title, "three");
    EXPECT_EQ(book.sheets[0].columnHeaders.count(0), 0U);
    EXPECT_THROW((void)after(book, adding({"a"})), Conflict);
    AddDatasets again = adding({"c"});
    again.datasets[0].place = parseAddress("C2");
    EXPECT_THROW((void)after(book, again), Conflict);
    EXPECT_THROW((void)after(book, adding({"=a"})), InvalidInput);
    EXPECT_THROW((void)after(book, adding({""})), InvalidInput);
    AddDatasets registered = adding({"c"});
    registered.place = false;
    EXPECT_EQ(after(book, registered).sheets, book.sheets);
}

TEST(Datasets, RemoveAndRename) {
    Workbook book = filledWorkbook(2, 1);
    const Workbook renamed = after(book, RenameDataset{"d1", "perfect"});
    EXPECT_EQ(cellAt(renamed, "A1").source, "perfect");
    EXPECT_TRUE(renamed.datasets.contains("perfect"));
    EXPECT_EQ(after(renamed, RenameDataset{"perfect", "d1"}), book);
    EXPECT_EQ(after(book, RenameDataset{"d1", "d1"}), book);
    EXPECT_THROW((void)after(book, RenameDataset{"d1", "d2"}), Conflict);
    EXPECT_THROW((void)after(book, RenameDataset{"d9", "x"}), NotFound);
    const Workbook removed = after(book, RemoveDataset{"d1"});
    EXPECT_EQ(removed.sheets[0].cells.size(), 1U);
    EXPECT_FALSE(removed.datasets.contains("d1"));
    EXPECT_THROW((void)after(removed, RemoveDataset{"d1"}), NotFound);
}

TEST(Datasets, PathPrefixesAreWholeFolders) {
    Workbook book = filledWorkbook(2, 1);
    book.datasets["d2"].files = {"/database/d2.nrrd"};
    const Workbook moved = after(book, ReplacePathPrefix{"/data", "/mnt/new"});
    EXPECT_EQ(moved.datasets.at("d1").files[0], "/mnt/new/d1.nrrd");
    EXPECT_EQ(moved.datasets.at("d2").files[0], "/database/d2.nrrd");
    EXPECT_THROW((void)after(book, ReplacePathPrefix{"/nowhere", "/x"}), NotFound);
    EXPECT_THROW((void)after(book, ReplacePathPrefix{"", "/x"}), InvalidInput);
}

TEST(Sheets, AddRenameDelete) {
    Workbook book = after(filledWorkbook(2, 1), AddSheet{""});
    EXPECT_EQ(book.sheets[1].name, "Sheet2");
    book.sheets[1].cells[{0, 0}].source = "=Sheet1!A1+sheet1!B1";
    const Workbook renamed = after(book, RenameSheet{"Sheet1", "My data"});
    EXPECT_EQ(renamed.sheets[1].cells.at({0, 0}).source, "='My data'!A1+'My data'!B1");
    EXPECT_EQ(after(renamed, DeleteSheet{"My data"}).sheets[0].cells.at({0, 0}).source, "=#REF!+#REF!");
    EXPECT_THROW((void)after(book, AddSheet{"SHEET1"}), Conflict);
    EXPECT_THROW((void)after(book, RenameSheet{"Sheet2", "sheet1"}), Conflict);
    EXPECT_THROW((void)after(book, RenameSheet{"Sheet2", "a!b"}), InvalidInput);
    EXPECT_NO_THROW((void)after(book, RenameSheet{"Sheet2", "SHEET2"}));
    EXPECT_THROW((void)after(filledWorkbook(1, 1), DeleteSheet{"Sheet1"}), Conflict);
}

TEST(Levels, AreSetPerSheetAndGivenBack) {
    Workbook book = after(filledWorkbook(1, 1), AddSheet{""});
    const LevelSettings slope{.policy = LevelPolicy::Slope};
    book = after(book, SetLevels{"sheet2", slope});
    EXPECT_EQ(book.sheets[1].levels, slope);
    EXPECT_FALSE(book.sheets[0].levels);
    EXPECT_FALSE(after(book, SetLevels{"Sheet2", std::nullopt}).sheets[1].levels);
    EXPECT_THROW((void)after(book, SetLevels{"Sheet9", slope}), NotFound);
    EXPECT_EQ(caught<InvalidInput>([&] {
                  (void)after(book, SetLevels{"Sheet1", LevelSettings{.frameMs = -1}});
              }).field(),
              "frame_ms");
    EXPECT_EQ(commandLabel(SetLevels{"Sheet1", slope}), "Levels of detail: slope");
}

TEST(Commands, AnEditLeavesTheOldSnapshotAlone) {
    const Workbook start = filledWorkbook(2, 2);
    const Workbook copy = start;
    (void)after(start, SetLayout{"Sheet1", 4});
    (void)after(start, RemoveDataset{"d1"});
    EXPECT_EQ(start, copy);
}

TEST(Commands, LabelsSayWhatUndoTakesBack) {
    EXPECT_EQ(commandLabel(SetStyle{"Sheet1", Layer::ofCell({1, 1}), patch("camera.fov", 40.0)}),
              "Set camera.fov of cell B2");
    EXPECT_EQ(commandLabel(SetStyle{"Sheet1", Layer::sheet(), {{"camera.fov", std::nullopt}}}),
              "Reset camera.fov of sheet");
    EXPECT_EQ(commandLabel(DeleteLines{"Sheet1", Axis::Rows, 0, 2}), "Delete 2 rows");
}

} // namespace
} // namespace voxsheet::sheet
