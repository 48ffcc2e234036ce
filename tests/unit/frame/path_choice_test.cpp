#include "frame/path_choice.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxsheet {
namespace {

/// The kernels may be missing in this build.
bool hasKernels() { return candidatePaths(Technique::Raycast).size() > 1; }

PathChoice choiceOf(const std::vector<PathChoice>& choices, Technique technique) {
    return *std::find_if(choices.begin(), choices.end(),
                         [&](const PathChoice& each) { return each.technique == technique; });
}

MeasuredPath measured(RenderPath path, double low, double ms, double high, std::size_t pixelsApart = 0) {
    return {path, {ms, low, high, 0.95, 9}, {pixelsApart, 1000}};
}

RenderPaths kernelsByRule() {
    gpu::Workarounds workarounds;
    workarounds.simdRays = true;
    return pathsByRule(workarounds);
}

TEST(PathChoice, IsByRuleUnlessSomethingElseIsKnown) {
    const auto choices = choosePaths(pathsByRule({}), {}, {});
    ASSERT_EQ(choices.size(), kTechniques.size());
    for (const PathChoice& choice : choices) {
        EXPECT_EQ(choice.path, RenderPath::Shader) << techniqueName(choice.technique);
        EXPECT_EQ(choice.reason, PathReason::Rule);
        EXPECT_EQ(choice.candidates.front(), RenderPath::Shader);
    }
    if (!hasKernels()) GTEST_SKIP() << "no kernels in this build";
    const auto byKernels = choosePaths(kernelsByRule(), {}, {});
    for (const Technique technique :
         {Technique::Slices, Technique::Raycast, Technique::Mip, Technique::Isosurface})
        EXPECT_EQ(choiceOf(byKernels, technique).path, RenderPath::Simd) << techniqueName(technique);
    EXPECT_EQ(choiceOf(byKernels, Technique::Surface).path, RenderPath::Shader);
    EXPECT_EQ(choiceOf(byKernels, Technique::Surface).candidates.size(), 1U);
}

TEST(PathChoice, WhatIsForcedWinsOverWhatIsCalibratedAndThatOverTheRule) {
    if (!hasKernels()) GTEST_SKIP() << "no kernels in this build";
    const std::vector<CalibratedPath> calibrated{
        {Technique::Raycast, RenderPath::Simd, 1.5, "2026-01-31"},
        {Technique::Mip, RenderPath::Simd, 2.5, "2026-01-31"},
        {Technique::Surface, RenderPath::Simd, 9.0, "2026-01-31"}}; // is none of its candidates
    const auto choices = choosePaths({}, calibrated, {{Technique::Raycast, RenderPath::Shader}});
    EXPECT_EQ(choiceOf(choices, Technique::Raycast).path, RenderPath::Shader);
    EXPECT_EQ(choiceOf(choices, Technique::Raycast).reason, PathReason::Forced);
    EXPECT_FALSE(choiceOf(choices, Technique::Raycast).calibrated);
    EXPECT_EQ(choiceOf(choices, Technique::Mip).path, RenderPath::Simd);
    EXPECT_EQ(choiceOf(choices, Technique::Mip).reason, PathReason::Calibrated);
    EXPECT_EQ(choiceOf(choices, Technique::Mip).calibrated, calibrated[1]);
    EXPECT_EQ(choiceOf(choices, Technique::Surface).path, RenderPath::Shader);
    EXPECT_EQ(choiceOf(choices, Technique::Surface).reason, PathReason::Rule);
    EXPECT_EQ(pathsOf(choices).of(Technique::Mip), RenderPath::Simd);
}

TEST(PathChoice, ForcedPathsThatAreNoneSayWhatThereIs) {
    EXPECT_EQ(parseForcedPaths({"raycast=shader"}), (ForcedPaths{{Technique::Raycast, RenderPath::Shader}}));
    const auto refusal = [](const std::string& text) -> std::string {
        try {
            static_cast<void>(parseForcedPaths({text}));
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.field(), "--path");
            return error.what();
        }
        return "taken";
    };
    EXPECT_NE(refusal("raycats=shader").find("slices, raycast, mip"), std::string::npos);
    EXPECT_NE(refusal("raycast=warp").find("choose of shader"), std::string::npos);
    EXPECT_NE(refusal("surface=simd").find("surface has no path `simd`"), std::string::npos);
    EXPECT_NE(refusal("raycast").find("TECHNIQUE=PATH"), std::string::npos);
    EXPECT_NE(refusal("raycast=").find("no path ``"), std::string::npos);
}

TEST(PathChoice, ACalibrationLeavesTheRuleOnlyForAClearWin) {
    const auto chosen = [](double low, double ms, double high) {
        const std::vector<MeasuredPath> paths{measured(RenderPath::Shader, low, ms, high),
                                              measured(RenderPath::Simd, 99.0, 100.0, 101.0)};
        return fastestPath(Technique::Raycast, RenderPath::Simd, paths);
    };
    EXPECT_EQ(chosen(49.0, 50.0, 51.0).path, RenderPath::Shader);
    EXPECT_DOUBLE_EQ(chosen(49.0, 50.0, 51.0).ratio, 2.0);
    EXPECT_EQ(chosen(40.0, 50.0, 98.0).path, RenderPath::Simd) << "the intervals are less than 5 % apart";
    EXPECT_DOUBLE_EQ(chosen(40.0, 50.0, 98.0).ratio, 0.5);
    EXPECT_EQ(chosen(190.0, 200.0, 210.0).path, RenderPath::Simd);
    EXPECT_DOUBLE_EQ(chosen(190.0, 200.0, 210.0).ratio, 2.0);
}

TEST(PathChoice, APathThatDrawsAnotherPictureIsRefused) {
    EXPECT_TRUE((PictureDistance{6, 1000}.isSamePicture()));
    EXPECT_FALSE((PictureDistance{7, 1000}.isSamePicture()));
    const std::vector<MeasuredPath> paths{measured(RenderPath::Shader, 99.0, 100.0, 101.0),
                                          measured(RenderPath::Simd, 9.0, 10.0, 11.0, 7)};
    for (const RenderPath rule : {RenderPath::Shader, RenderPath::Simd}) {
        const auto chosen = fastestPath(Technique::Mip, rule, paths);
        EXPECT_EQ(chosen.path, RenderPath::Shader);
        EXPECT_DOUBLE_EQ(chosen.ratio, 1.0) << "there is no other";
    }
    EXPECT_THROW((void)fastestPath(Technique::Mip, RenderPath::Simd, std::span(paths).first(1)),
                 InternalError);
}

} // namespace
} // namespace voxsheet
