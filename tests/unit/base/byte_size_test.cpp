#include "base/byte_size.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

TEST(ByteSize, ReadsWhatPeopleWrite) {
    EXPECT_EQ(parseBytes("4096", "x"), 4096U);
    EXPECT_EQ(parseBytes("512M", "x"), 512U << 20U);
    EXPECT_EQ(parseBytes("1.5GiB", "x"), 3U << 29U);
    EXPECT_EQ(parseBytes("2kB", "x"), 2048U);
    EXPECT_EQ(parseBytes("", "x"), 0U);
}

TEST(ByteSize, RefusesTheRestAndNamesTheOption) {
    for (const char* text : {"0", "-1G", "G", "1X", "1Gb", "1G1", "nan", "inf", "9999999T"}) {
        try {
            (void)parseBytes(text, "--texture-budget");
            ADD_FAILURE() << text;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.field(), "--texture-budget");
        }
    }
}

TEST(ByteSize, WritesWhatPeopleRead) {
    EXPECT_EQ(byteText(0), "0 B");
    EXPECT_EQ(byteText(std::uint64_t{256} << 20U), "256 MiB");
    EXPECT_EQ(byteText(std::uint64_t{3} << 29U), "1.5 GiB");
}

} // namespace
} // namespace voxsheet
