#include "base/program_file.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

// Under a dynamic loader of its own: tests/bundle/empty_root.sh.
TEST(ProgramFile, IsTheFileThatRuns) {
    EXPECT_EQ(programFile(), std::filesystem::canonical("/proc/self/exe"));
    EXPECT_EQ(std::filesystem::file_size(programBytes()), std::filesystem::file_size(programFile()));
}

} // namespace
} // namespace voxsheet
