#include "cli/bench/cases_table.h"

#include <gtest/gtest.h>

namespace voxsheet::cli {
namespace {

TEST(CasesTable, PutsTextsFirstAndNumbersUnderEachOther) {
    const auto cases = nlohmann::json::parse(R"([
        {"ms": 1.5, "technique": "raycast", "path": "simd", "chosen": true, "pixels_apart": 12},
        {"ms": 123, "technique": "mip", "path": "shader", "chosen": false, "pixels_apart": 0}])");
    EXPECT_EQ(casesTable(cases), "chosen  path    technique      ms  pixels_apart\n"
                                 "yes     simd    raycast      1.50            12\n"
                                 "no      shader  mip        123.00             0\n");
}

TEST(CasesTable, SaysWhereACaseLacksAValue) {
    const auto cases =
        nlohmann::json::parse(R"([{"name": "a", "ms": 2}, {"name": "b", "ratio": 1.5, "ms": null}])");
    EXPECT_EQ(casesTable(cases), "name  ms  ratio\n"
                                 "a      2      -\n"
                                 "b      -   1.50\n");
}

TEST(CasesTable, IsEmptyWhereNothingWasFound) { EXPECT_EQ(casesTable(nlohmann::json::array()), ""); }

} // namespace
} // namespace voxsheet::cli
