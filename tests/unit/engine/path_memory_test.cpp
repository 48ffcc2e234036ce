#include "engine/path_memory.h"

#include "base/log.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace voxsheet::engine {
namespace {

namespace fs = std::filesystem;

RenderDevice device() {
    RenderDevice made;
    made.vendor = "Mesa";
    made.renderer = "llvmpipe";
    made.version = "4.5";
    made.workarounds = {"simd-rays"};
    return made;
}

const std::vector<CalibratedPath> kPaths{{Technique::Raycast, RenderPath::Simd, 3.25, "2026-01-31"},
                                         {Technique::Isosurface, RenderPath::Shader, 1.5, "2026-02-01"}};

class PathMemory : public testing::Test {
protected:
    PathMemory() {
        setLogSink([this](LogLevel, std::string_view message) { said_ += message; });
    }
    ~PathMemory() override { setLogSink({}); }

    [[nodiscard]] fs::path file() const { return pathMemoryFile(folder_.path(), pathDevice(device())); }

    test::TemporaryFolder folder_;
    std::string said_;
};

TEST_F(PathMemory, GivesBackWhatItWasGivenUntilItIsForgotten) {
    EXPECT_TRUE(rememberedPaths(folder_.path(), device()).empty());
    EXPECT_TRUE(rememberedPaths({}, device()).empty());
    rememberPaths(folder_.path(), device(), kPaths);
    EXPECT_EQ(rememberedPaths(folder_.path(), device()), kPaths);
    rememberPaths(folder_.path(), device(), {kPaths[1]});
    EXPECT_EQ(rememberedPaths(folder_.path(), device()), std::vector{kPaths[1]});
    EXPECT_TRUE(forgetPaths(folder_.path(), device()));
    EXPECT_FALSE(forgetPaths(folder_.path(), device()));
    EXPECT_TRUE(rememberedPaths(folder_.path(), device()).empty());
    EXPECT_EQ(said_, "");
}

TEST_F(PathMemory, KnowsNothingOfAnotherDevice) {
    rememberPaths(folder_.path(), device(), kPaths);
    for (int changed = 0; changed < 4; ++changed) {
        auto other = device();
        if (changed == 0) other.vendor = "NVIDIA";
        if (changed == 1) other.renderer = "H100";
        if (changed == 2) other.version = "4.6";
        if (changed == 3) other.workarounds = {};
        EXPECT_TRUE(rememberedPaths(folder_.path(), other).empty()) << changed;
    }
    EXPECT_EQ(said_, "");
}

TEST_F(PathMemory, ADamagedFileIsNamedAndIgnored) {
    rememberPaths(folder_.path(), device(), kPaths);
    std::ifstream in(file());
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    const auto with = [&](const std::string& what, const std::string& by) {
        auto text = whole;
        return text.replace(text.find(what), what.size(), by);
    };
    const std::vector<std::string> damages{"",
                                           "{}",
                                           whole.substr(0, whole.size() / 2),
                                           with("raycast", "raycats"),
                                           with("simd\"", "warp\""),
                                           with("3.25", "-1"),
                                           with("3.25", "null"),
                                           with("2026-01-31", "<b>"),
                                           with("llvmpipe", "softpipe"),
                                           std::string(100000, ' ')};
    for (const std::string& damage : damages) {
        std::ofstream(file(), std::ios::trunc) << damage;
        said_.clear();
        EXPECT_TRUE(rememberedPaths(folder_.path(), device()).empty()) << damage;
        EXPECT_NE(said_.find(file().string()), std::string::npos) << damage << ": " << said_;
        EXPECT_NE(said_.find("voxsheet bench calibrate"), std::string::npos) << damage << ": " << said_;
    }
    rememberPaths(folder_.path(), device(), kPaths);
    EXPECT_EQ(rememberedPaths(folder_.path(), device()), kPaths);
}

} // namespace
} // namespace voxsheet::engine
