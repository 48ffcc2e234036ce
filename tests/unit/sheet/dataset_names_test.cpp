#include "sheet/dataset_names.h"
#include "sheet/layout_pattern.h"
#include "sheet/utf8.h"

#include "sheet_fixture.h"

#include <random>

namespace voxsheet::sheet {
namespace {

using Names = std::vector<std::string>;

TEST(NaturalOrder, NumbersCompareAsNumbers) {
    Names names{"run10",
                "run2",
                "Run1",
                "run02",
                "run",
                "x",
                "run2b",
                "run2a",
                "run18446744073709551617",
                "run18446744073709551616"};
    sortNaturally(names);
    EXPECT_EQ(names, Names({"run", "Run1", "run02", "run2", "run2a", "run2b", "run10",
                            "run18446744073709551616", "run18446744073709551617", "x"}));
}

TEST(NaturalOrder, IsAStrictTotalOrder) {
    std::mt19937 random(9);
    Names names;
    for (int i = 0; i < 60; ++i) {
        std::string name;
        for (auto n = random() % 6; n > 0; --n)
            name += "01aA/9"[random() % 6];
        names.push_back(name);
    }
    for (const std::string& a : names)
        for (const std::string& b : names) {
            EXPECT_EQ(naturalLess(a, b) || naturalLess(b, a), a != b) << a << " " << b;
            EXPECT_FALSE(naturalLess(a, b) && naturalLess(b, a));
            for (const std::string& c : names) {
                const bool chained = naturalLess(a, b) && naturalLess(b, c);
                EXPECT_TRUE(!chained || naturalLess(a, c)) << a << " " << b << " " << c;
            }
        }
}

TEST(DatasetNames, ShortestTailThatTellsApart) {
    EXPECT_EQ(distinguishingNames({"/data/a.nrrd", "/data/b.nrrd"}), Names({"a.nrrd", "b.nrrd"}));
    EXPECT_EQ(distinguishingNames({"/x/run1/CHGCAR", "/x/run2/CHGCAR", "/x/run2/LOCPOT"}),
              Names({"run1/CHGCAR", "run2/CHGCAR", "LOCPOT"}));
    EXPECT_EQ(distinguishingNames({"a/x/out", "b/x/out"}), Names({"a/x/out", "b/x/out"}));
    EXPECT_EQ(distinguishingNames({"./a", "a"}), Names({"a", "a (2)"})) << "the same file twice";
    EXPECT_EQ(distinguishingNames({"x/a", "a"}), Names({"x/a", "a"}));
    EXPECT_EQ(distinguishingNames({"/data/a", "/data/a"}, {"a"}).size(), 2U);
}

TEST(DatasetNames, KeepsClearOfNamesThatAreTaken) {
    EXPECT_EQ(distinguishingNames({"/x/run1/a"}, {"a"}), Names({"run1/a"}));
    EXPECT_EQ(distinguishingNames({"a"}, {"a", "a (2)"}), Names({"a (3)"}));
}

TEST(DatasetNames, AreAlwaysAllowedAndDifferent) {
    std::mt19937 random(4);
    Names paths{"",
                "/",
                "=1+1",
                " a ",
                "\xff\xfe",
                "a\nb",
                std::string(500, 'y'),
                std::string(300, '='),
                "é/é",
                "x/" + std::string(250, '\xc3')};
    for (int i = 0; i < 300; ++i) {
        std::string path;
        for (auto n = 1 + random() % 8; n > 0; --n)
            path += "ab/.= \xc3\n"[random() % 8];
        paths.push_back(path);
    }
    const Names names = distinguishingNames(paths, {"a", "b"});
    ASSERT_EQ(names.size(), paths.size());
    std::set<std::string> seen{"a", "b"};
    for (const std::string& name : names) {
        EXPECT_NO_THROW(validateDatasetName(name)) << inQuotes(name);
        EXPECT_TRUE(seen.insert(name).second) << name;
    }
}

TEST(LayoutPattern, PlacesByRowAndColumn) {
    const auto placed = placeByPattern("sub-{row}_{col}.nii.gz",
                                       {"/d/sub-10_T1.nii.gz", "/d/sub-2_T2.nii.gz", "/d/sub-2_T1.nii.gz"});
    EXPECT_EQ(placed.rowTitles, Names({"2", "10"}));
    EXPECT_EQ(placed.columnTitles, Names({"T1", "T2"}));
    EXPECT_EQ(placed.places, std::vector<Address>({{0, 1}, {1, 0}, {0, 0}}));
    EXPECT_EQ(placed.layout, (Layout{2, 2}));
}

TEST(LayoutPattern, FoldersAndStars) {
    const auto placed = placeByPattern("{row}/*_{col}", {"/x/r1/abc_a", "/x/r2/_b"});
    EXPECT_EQ(placed.rowTitles, Names({"r1", "r2"}));
    EXPECT_EQ(placed.columnTitles, Names({"a", "b"}));
    EXPECT_EQ(placeByPattern("run{col}", {"run1", "run10", "run2"}).places,
              std::vector<Address>({{0, 0}, {2, 0}, {1, 0}}));
    EXPECT_EQ(placeByPattern("{row}_{col}", {"a_b_c"}).rowTitles, Names({"a"}))
        << "as few characters as possible";
}

TEST(LayoutPattern, WhatDoesNotFitIsNamed) {
    for (const char* pattern : {"", "plain", "{row}{row}", "{rows}", "{row", "row}", "{}", "*"})
        EXPECT_EQ(caught<InvalidInput>([&] { (void)placeByPattern(pattern, {"a"}); }).field(), "layout")
            << pattern;
    EXPECT_THROW((void)placeByPattern("sub-{row}", {"sub-1", "ses-2"}), InvalidInput);
    EXPECT_THROW((void)placeByPattern("sub-{row}", {"sub-"}), InvalidInput)
        << "a placeholder stands for something";
    EXPECT_THROW((void)placeByPattern("{row}/x", {"x"}), InvalidInput);
    const Error shared = caught<InvalidInput>([] { (void)placeByPattern("{row}_*", {"a_1", "a_2"}); });
    EXPECT_NE(std::string(shared.what()).find("A1"), std::string::npos);
    Names many;
    for (int i = 0; i < 1100; ++i)
        many.push_back("r" + std::to_string(i));
    EXPECT_THROW((void)placeByPattern("r{row}", many), LimitExceeded);
}

TEST(LayoutPattern, HostilePatternsTakeNoTime) {
    std::string pattern = "{row}";
    for (int i = 0; i < 400; ++i)
        pattern += "*a";
    EXPECT_THROW((void)placeByPattern(pattern + "b", {std::string(500, 'a')}), InvalidInput);
}

TEST(Utf8, WellFormedOnly) {
    for (const char* text : {"", "abc", "é", "€", "\xf0\x9f\x98\x80", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"})
        EXPECT_TRUE(isValidUtf8(text)) << text;
    for (const char* text : {"\x80", "\xc0\xaf", "\xc3", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                             "\xf5\x80\x80\x80", "a\xff"})
        EXPECT_FALSE(isValidUtf8(text));
    EXPECT_EQ(replaceInvalidUtf8("a\xff"
                                 "b"),
              "a\xEF\xBF\xBD"
              "b");
    EXPECT_TRUE(isValidUtf8(inQuotes(std::string(59, 'x') + "€€€")));
}

} // namespace
} // namespace voxsheet::sheet
