// The kernels of simd/ draw what the shaders draw, with whatever instruction set.
#include "image/random_tiles.h"
#include "simd/kernels.h"

#include <hwy/targets.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>

namespace voxsheet::image {
namespace {

constexpr int kTilesOfEach = 24;
/// Of all pixels, that something must be seen in: pictures of nothing are always the same.
constexpr double kLeastSeen = 0.05;
constexpr double kStep8Bit = 1.0 / 255.0;

/// Pixels whose rays touch the edge of a face, a voxel or a cut, or graze a surface: 32-bit floats that are
/// rounded in another order decide them differently.
constexpr double kUndecidedPart = 0.004;

/// Set while it lives.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value, 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }

private:
    const char* name_;
    std::optional<std::string> before_;
};

class SimdRays : public RandomTiles {
protected:
    void SetUp() override {
        if (!painter.context().workarounds().simdRays)
            GTEST_SKIP() << "rays are marched by shaders on this device";
    }

    /// Every other one uncut, for much of what cuts leave is small.
    TileSpec nextTile(const Grid& grid, int trial) {
        auto tile = randomTile(grid, trial);
        if (trial % 2 == 1) tile.clip = {};
        tile.adaptiveSampling = trial % 4 < 3;
        return tile;
    }

    void expectSomethingSeen() const {
        EXPECT_GE(static_cast<double>(seen_), kLeastSeen * static_cast<double>(pixels_));
    }

    void expectSame(const TileSpec& tile, const fields::Picture& one, const fields::Picture& other) {
        pixels_ += one.pixels.size();
        seen_ += static_cast<std::size_t>(std::count_if(one.pixels.begin(), one.pixels.end(),
                                                        [](const auto& pixel) { return pixel.w > 0.1; }));
        const auto apart = pixelsApart(one, other, kStep8Bit);
        EXPECT_LE(static_cast<double>(apart), 2.0 + kUndecidedPart * static_cast<double>(one.pixels.size()))
            << apart << " of " << one.pixels.size() << " pixels are apart, technique "
            << fields::nameOf(tile.technique);
    }

private:
    std::size_t pixels_ = 0;
    std::size_t seen_ = 0;
};

TEST_P(SimdRays, DrawWhatTheShadersDraw) {
    const Environment environment("VOXSHEET_DISABLE_WORKAROUNDS", "simd-rays");
    TilePainter byShaders(painter.sharedVolumes());
    ASSERT_FALSE(byShaders.context().workarounds().simdRays);
    for (int trial = 0; trial < kTilesOfEach; ++trial) {
        const auto grid = randomGrid();
        const auto tile = nextTile(grid, trial);
        SCOPED_TRACE(std::to_string(trial) + " " + describe(tile, grid));
        expectSame(tile, painter.draw(tile), byShaders.draw(tile));
    }
    expectSomethingSeen();
}

TEST_P(SimdRays, DrawTheSameWithEveryInstructionSet) {
    const auto best = std::string(simd::instructionSet());
    std::set<std::string> used;
    for (int trial = 0; trial < kTilesOfEach; ++trial) {
        const auto grid = randomGrid();
        const auto tile = nextTile(grid, trial);
        SCOPED_TRACE(std::to_string(trial) + " " + describe(tile, grid));
        const auto picture = painter.draw(tile);
        for (auto targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
            hwy::SetSupportedTargetsForTest(targets & -targets);
            SCOPED_TRACE(simd::instructionSet());
            used.insert(simd::instructionSet());
            expectSame(tile, picture, painter.draw(tile));
        }
        hwy::SetSupportedTargetsForTest(0);
    }
    expectSomethingSeen();
    EXPECT_EQ(used.count(best), 1U);
    EXPECT_GE(used.size(), 2U) << "only " << best << " was tested";
}

INSTANTIATE_TEST_SUITE_P(All, SimdRays,
                         testing::Values(Technique::Slices, Technique::Raycast, Technique::Mip,
                                         Technique::Isosurface),
                         [](const testing::TestParamInfo<Technique>& tile) {
                             return fields::nameOf(tile.param);
                         });

} // namespace
} // namespace voxsheet::image
