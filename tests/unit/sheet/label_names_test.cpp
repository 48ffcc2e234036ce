#include "sheet/label_names.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet::sheet {
namespace {

TEST(LabelNames, ValuesHaveNamesColoursOrBoth) {
    const auto names = parseLabelNames("1: liver; 2: left kidney #aa3300;-3 #0f0 ; 17:gall #3 ;");
    ASSERT_EQ(names.size(), 4U);
    EXPECT_EQ(names.at(1), (LabelName{"liver", std::nullopt}));
    EXPECT_EQ(names.at(2), (LabelName{"left kidney", Colour{{0xaa, 0x33, 0, 255}}}));
    EXPECT_EQ(names.at(-3), (LabelName{"", Colour{{0, 255, 0, 255}}}));
    EXPECT_EQ(names.at(17).name, "gall #3") << "no colour has one digit";
}

TEST(LabelNames, WhatIsNoLabelIsQuoted) {
    for (const char* text : {"liver", "1.5: half", "1", "1: a; 1: b", ";", "1:", "x #ffffff"}) {
        try {
            (void)parseLabelNames(text);
            FAIL() << text;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.field(), "labels.names") << text;
        }
    }
}

} // namespace
} // namespace voxsheet::sheet
