#include "base/huge_page_block.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace voxsheet {
namespace {

constexpr std::size_t kPageBytes = std::size_t{2} << 20;

/// Bytes in huge pages of the mapping that holds the address.
std::size_t hugeBytesAt(const void* address) {
    const auto wanted = reinterpret_cast<std::uintptr_t>(address);
    std::ifstream maps("/proc/self/smaps");
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
        std::istringstream words(line);
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        if (words >> std::hex >> begin >> dash >> end && dash == '-')
            here = begin <= wanted && wanted < end;
        else if (here && line.starts_with("AnonHugePages:"))
            return std::stoul(line.substr(line.find(':') + 1)) << 10U;
    }
    return 0;
}

TEST(HugePageBlock, IsThereToItsLastByte) {
    EXPECT_EQ(HugePageBlock().size(), 0U);
    for (const std::size_t bytes : {std::size_t{1}, kPageBytes - 1, kPageBytes, 3 * kPageBytes + 5}) {
        HugePageBlock block(bytes);
        ASSERT_EQ(block.size(), bytes);
        std::memset(block.data(), 7, bytes);
        const HugePageBlock moved = std::move(block);
        EXPECT_EQ(moved.data()[0], std::byte{7});
        EXPECT_EQ(moved.data()[bytes - 1], std::byte{7});
    }
}

TEST(HugePageBlock, LiesInHugePagesWhereTheSystemGivesThem) {
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    std::string mode;
    std::getline(file, mode);
    if (mode.empty() || mode.find("[never]") != std::string::npos)
        GTEST_SKIP() << "this system gives no huge pages";
    HugePageBlock block(64 * kPageBytes);
    std::memset(block.data(), 1, block.size());
    // Memory may be too scattered for some of them.
    EXPECT_GE(hugeBytesAt(block.data() + kPageBytes), 8 * kPageBytes);
}

} // namespace
} // namespace voxsheet
