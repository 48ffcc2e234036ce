#include "sheet/address.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet::sheet {
namespace {

TEST(Address, ReadsAndWritesCells) {
    EXPECT_EQ(parseAddress("A1"), (Address{0, 0}));
    EXPECT_EQ(parseAddress("b12"), (Address{1, 11}));
    EXPECT_EQ(addressName(Address{27, 9}), "AB10");
}

TEST(Address, EveryColumnNameReadsBack) {
    for (int column = 0; column < kMaxColumns; ++column)
        EXPECT_EQ(parseColumn(columnName(column)), column);
    EXPECT_EQ(columnName(25), "Z");
    EXPECT_EQ(columnName(26), "AA");
    EXPECT_EQ(columnName(kMaxColumns - 1), "AMJ");
}

TEST(Address, RefusesWhatIsNoCell) {
    for (const char* text : {"", "A", "1", "A0", "A01", "1A", "A-1", "A1 ", " A1", "A1B", "AMK1", "A1025",
                             "A1:B2", "A99999999999999999999", "ZZZZZZZZZZZZZZZZZZZZ1", "Ä1", "A1.5", "$A$1"})
        EXPECT_THROW((void)parseAddress(text), InvalidInput) << text;
}

TEST(Address, ReadingOrderGoesRowByRow) {
    EXPECT_LT((Address{5, 0}), (Address{0, 1}));
    EXPECT_LT((Address{0, 1}), (Address{1, 1}));
}

TEST(Address, RangesTakeCornersInAnyOrder) {
    const AddressRange range{{0, 0}, {2, 2}};
    EXPECT_EQ(parseRange("A1:C3"), range);
    EXPECT_EQ(parseRange("C1:A3"), range);
    EXPECT_EQ(parseRange("c3:a1"), range);
    EXPECT_EQ(parseRange("B2"), (AddressRange{{1, 1}, {1, 1}}));
    EXPECT_EQ(rangeName(range), "A1:C3");
    EXPECT_EQ(range.columns(), 3);
    EXPECT_EQ(range.rows(), 3);
    EXPECT_TRUE(range.contains({1, 2}));
    EXPECT_FALSE(range.contains({3, 0}));
    EXPECT_THROW((void)parseRange("A1:"), InvalidInput);
    EXPECT_THROW((void)parseRange("A1:B2:C3"), InvalidInput);
}

TEST(Address, SheetsAreQuotedWhereNeeded) {
    EXPECT_EQ(parseSheetAddress("Sheet2!B4"), (SheetAddress{"Sheet2", {1, 3}}));
    EXPECT_EQ(parseSheetAddress("'My sheet'!B4"), (SheetAddress{"My sheet", {1, 3}}));
    EXPECT_EQ(parseSheetAddress("B4"), (SheetAddress{"", {1, 3}}));
    EXPECT_EQ(addressName(SheetAddress{"My sheet", {1, 3}}), "'My sheet'!B4");
    EXPECT_EQ(addressName(SheetAddress{"Data_2x", {1, 3}}), "Data_2x!B4");
    EXPECT_EQ(addressName(SheetAddress{"B2", {1, 3}}), "'B2'!B4") << "would read as a cell";
    for (const char* text : {"!B4", "My sheet!B4", "''!B4", "'a'b'!B4", "Sheet2!", "Sheet2!Sheet3!B4"})
        EXPECT_THROW((void)parseSheetAddress(text), InvalidInput) << text;
}

TEST(Address, EverySheetNameThatIsAllowedReadsBack) {
    for (const char* name : {"a", "Sheet1", "two words", "Größe", "1st", "x.y", "A1"}) {
        validateSheetName(name);
        const SheetAddress address{name, {3, 4}};
        EXPECT_EQ(parseSheetAddress(addressName(address)), address) << name;
    }
    for (const std::string& name :
         {std::string(), std::string("a!b"), std::string("a'b"), std::string(" a"), std::string("a "),
          std::string(65, 'x'), std::string("a\nb"), std::string("\xff")})
        EXPECT_THROW(validateSheetName(name), InvalidInput) << name;
}

} // namespace
} // namespace voxsheet::sheet
