// What a user reads on a machine without EGL, and what the environment switches; in child processes, because
// EGL is loaded once per process.
#include "base/errors.h"
#include "gl_fixture.h"

#include <cstdlib>
#include <iostream>

namespace voxsheet::gpu {
namespace {

[[noreturn]] void makeContextWithoutVendors() {
    // The vendor-neutral libEGL finds no driver there, as on a machine without libgl1-mesa-dri.
    unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES"); // goes before folders
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    try {
        const Context context;
        std::cerr << "made a context all the same\n";
        std::exit(1);
    } catch (const GpuError& error) {
        std::cerr << error.what() << '\n';
        std::exit(listRenderDevices().empty() ? 3 : 4);
    }
}

TEST(NoEgl, TheErrorNamesThePackages) {
    // Not haveOpenGl(): the child runs this test from its start, and must not have loaded EGL yet.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(makeContextWithoutVendors(), ::testing::ExitedWithCode(3), "libegl1 .*libgl1-mesa-dri");
}

TEST(Environment, SwitchesWorkaroundsOff) {
    if (!haveOpenGl()) GTEST_SKIP() << "no EGL device gives OpenGL 4.5";
    setenv("VOXSHEET_DISABLE_WORKAROUNDS", "r8-as-r16,clear-before-compute,coarse-filter-weights,simd-rays",
           1);
    EXPECT_TRUE(Context().device().workarounds.empty());
    setenv("VOXSHEET_DISABLE_WORKAROUNDS", "warp-drive", 1);
    EXPECT_THROW(Context(), InvalidInput);
    unsetenv("VOXSHEET_DISABLE_WORKAROUNDS");
}

} // namespace
} // namespace voxsheet::gpu
