#include "engine/unit_text.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

TEST(UnitText, RaisesPowersOfOneDigit) {
    EXPECT_EQ(unitText("e/Å^3"), "e/Å³");
    EXPECT_EQ(unitText("kg m^-1 s^-2"), "kg m⁻¹ s⁻²");
    EXPECT_EQ(unitText("eV"), "eV");
    EXPECT_EQ(unitText(""), "");
}

TEST(UnitText, LeavesWhatIsNoSuchPower) {
    EXPECT_EQ(unitText("m^12"), "m^12");
    EXPECT_EQ(unitText("m^"), "m^");
    EXPECT_EQ(unitText("m^-"), "m^-");
    EXPECT_EQ(unitText("m^x"), "m^x");
}

} // namespace
} // namespace voxsheet::engine
