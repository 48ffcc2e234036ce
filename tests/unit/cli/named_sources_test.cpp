#include "cli/named_sources.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet::cli {
namespace {

const sheet::KeyTable& keys() {
    static const sheet::KeyTable table = sheet::makeKeyTable({"grey"});
    return table;
}

sheet::Workbook workbookOf(const std::vector<std::string>& words, const SheetShape& shape = {}) {
    return workbookOfWords(words, shape, "/data", keys());
}

std::string sourceAt(const sheet::Workbook& workbook, const std::string& address) {
    const auto* cell = workbook.sheets.front().find(sheet::parseAddress(address));
    return cell == nullptr ? std::string{} : cell->source;
}

TEST(NamedSources, FilesAloneAreSortedNaturally) {
    const auto workbook = workbookOf({"run10.nrrd", "run2.nrrd"});
    EXPECT_EQ(sourceAt(workbook, "A1"), "run2.nrrd");
    EXPECT_EQ(sourceAt(workbook, "B1"), "run10.nrrd");
    EXPECT_EQ(workbook.datasets.at("run2.nrrd").files.front(), "/data/run2.nrrd");
}

TEST(NamedSources, BesideAFormulaEveryWordStaysInItsPlace) {
    const auto workbook = workbookOf({"z.nrrd", "a.nrrd", "=B1-A1"}, {3, "", false});
    EXPECT_EQ(sourceAt(workbook, "A1"), "z.nrrd");
    EXPECT_EQ(sourceAt(workbook, "B1"), "a.nrrd");
    EXPECT_EQ(sourceAt(workbook, "C1"), "=B1-A1");
    EXPECT_EQ(workbook.sheets.front().columns, 3);
    EXPECT_EQ(workbook.sheets.front().rows, 1);
    EXPECT_EQ(workbook.datasets.size(), 2U);
}

TEST(NamedSources, AFormulaMayStandFirstAndRowsFollowTheColumns) {
    const auto workbook = workbookOf({"=A2-B1", "b", "c", "=B1/2", "d"}, {2, "", false});
    EXPECT_EQ(sourceAt(workbook, "A1"), "=A2-B1");
    EXPECT_EQ(sourceAt(workbook, "B1"), "b");
    EXPECT_EQ(sourceAt(workbook, "A2"), "c");
    EXPECT_EQ(sourceAt(workbook, "B2"), "=B1/2");
    EXPECT_EQ(sourceAt(workbook, "A3"), "d");
}

TEST(NamedSources, WithoutColumnsTheSheetIsNearSquare) {
    const auto workbook = workbookOf({"a", "b", "=B1-A1"});
    EXPECT_EQ(sourceAt(workbook, "A2"), "=B1-A1");
    EXPECT_TRUE(workbook.sheets.front().autoLayout);
}

TEST(NamedSources, ALayoutPlacesFilesAndLeavesTheFreeCellsToFormulas) {
    const auto workbook =
        workbookOf({"=A1", "s2_x.nii", "s1_x.nii", "s1_y.nii"}, {{}, "{row}_{col}.nii", false});
    EXPECT_EQ(sourceAt(workbook, "A1"), "s1_x.nii");
    EXPECT_EQ(sourceAt(workbook, "B1"), "s1_y.nii");
    EXPECT_EQ(sourceAt(workbook, "A2"), "s2_x.nii");
    EXPECT_EQ(sourceAt(workbook, "B2"), "=A1");
}

TEST(NamedSources, NumberedFilesAreOneDatasetWhenAskedFor) {
    const std::vector<std::string> words{"=B1", "s10.tif", "s9.tif", "head.nrrd", "s8.tif"};
    const auto workbook = workbookOf(words, {2, "", true});
    EXPECT_EQ(workbook.datasets.size(), 2U);
    EXPECT_EQ(workbook.datasets.at("s8.tif").files,
              (std::vector<std::string>{"/data/s8.tif", "/data/s9.tif", "/data/s10.tif"}));
    EXPECT_EQ(sourceAt(workbook, "A1"), "=B1");
    EXPECT_EQ(sourceAt(workbook, "B1"), "head.nrrd");
    EXPECT_EQ(sourceAt(workbook, "A2"), "s8.tif");
    EXPECT_EQ(workbookOf(words, {2, "", false}).datasets.size(), 4U);
}

TEST(NamedSources, AFileOfSuchANameIsReachedByItsFolder) {
    EXPECT_TRUE(isFormula("=B1-A1"));
    EXPECT_FALSE(isFormula("./=B1-A1"));
    EXPECT_FALSE(isFormula(""));
}

TEST(NamedSources, ColumnsThatASheetCannotHaveAreNamed) {
    EXPECT_THROW((void)workbookOf({"a", "=A1"}, {0, "", false}), InvalidInput);
}

} // namespace
} // namespace voxsheet::cli
