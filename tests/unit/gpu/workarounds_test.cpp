#include "gpu/workarounds.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet::gpu {
namespace {

constexpr const char* kLlvmpipe = "llvmpipe (LLVM 15.0.6, 256 bits)";

TEST(Workarounds, AreOnForTheDriversThatNeedThem) {
    EXPECT_EQ(workaroundsFor(kLlvmpipe, ""), (Workarounds{true, true, false, true}));
    EXPECT_EQ(workaroundsFor("NVIDIA H100 PCIe/PCIe/SSE2", ""), (Workarounds{false, false, true}));
    EXPECT_EQ(workaroundsFor("NVIDIA H200/PCIe/SSE2", "coarse-filter-weights"), Workarounds{});
}

TEST(Workarounds, CanBeSwitchedOffByName) {
    EXPECT_EQ(workaroundsFor(kLlvmpipe, "r8-as-r16"), (Workarounds{true, false, false, true}));
    EXPECT_EQ(workaroundsFor(kLlvmpipe, " clear-before-compute , r8-as-r16 "),
              (Workarounds{false, false, false, true}));
    EXPECT_EQ(workaroundNames(workaroundsFor(kLlvmpipe, "r8-as-r16")),
              (std::vector<std::string>{"clear-before-compute", "simd-rays"}));
    EXPECT_EQ(workaroundsFor(kLlvmpipe, "simd-rays"), (Workarounds{true, true}));
}

TEST(Workarounds, AreKnownAgainByTheirNames) {
    const Workarounds workarounds = workaroundsFor(kLlvmpipe, "r8-as-r16");
    EXPECT_EQ(workaroundsNamed(workaroundNames(workarounds)), workarounds);
    EXPECT_EQ(workaroundsNamed({"another"}), Workarounds{});
}

TEST(Workarounds, RefusesAnUnknownName) {
    EXPECT_THROW((void)workaroundsFor(kLlvmpipe, "r8-as-r61"), InvalidInput);
}

} // namespace
} // namespace voxsheet::gpu
