#include "resolution/dynamic_resolution.h"

#include "base/errors.h"
#include "invented_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace voxsheet {
namespace {

ResolutionRule ruleOf(ResolutionCriterion criterion) {
    ResolutionRule rule;
    rule.criterion = criterion;
    return rule;
}

/// Figure 6's shape at level 0; an eighth of its slope, and its bends at eight times the N, at each coarser
/// level.
double paperMs(int n, int level) {
    const int scale = 1 << (3 * level);
    return InventedCurve{0.0, {60.0 / scale, 81.0 / scale, 500.0 / scale}, {5 * scale, 25 * scale}}.at(n);
}

/// Adds datasets one by one, as users do, with a few frames at each N; returns where the level changed.
std::map<int, int> changesWhileGrowing(DynamicResolution& resolution, int lastN, double noise,
                                       unsigned seed = 1) {
    Noise noisy(noise, seed);
    std::map<int, int> levelOfN;
    for (int n = 1; n <= lastN; ++n) {
        for (int frame = 0; frame < 5; ++frame)
            resolution.addFrame(n, noisy(paperMs(n, resolution.level())));
        const auto decision = resolution.decide({n, 0});
        EXPECT_EQ(decision.level, resolution.level());
        if (decision.changed) levelOfN[n] = decision.level;
    }
    return levelOfN;
}

TEST(DynamicResolution, PaperRuleCatchesTheSecondTransition) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::Slope), 8);
    EXPECT_EQ(changesWhileGrowing(resolution, 64, 0.0), (std::map<int, int>{{27, 1}}));
    EXPECT_EQ(resolution.lastNOfLevel()[0], 25);
}

TEST(DynamicResolution, TheOtherSettingCatchesTheFirstAsWell) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::SlopeFirst), 8);
    const auto changes = changesWhileGrowing(resolution, 64, 0.0);
    ASSERT_EQ(changes.size(), 2U); // at level 1 the first transition is at N = 40
    EXPECT_EQ(changes.begin()->second, 1);
    EXPECT_GE(changes.begin()->first, 7);
    EXPECT_LE(changes.begin()->first, 9);
    EXPECT_GT(changes.rbegin()->first, 40);
    EXPECT_LE(changes.rbegin()->first, 52);
}

TEST(DynamicResolution, NoiseMovesTheSwitchByAFewDatasetsAtMost) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        DynamicResolution resolution(ruleOf(ResolutionCriterion::Slope), 8);
        const auto changes = changesWhileGrowing(resolution, 64, 0.01, seed);
        ASSERT_EQ(changes.size(), 1U) << "seed " << seed;
        EXPECT_NEAR(changes.begin()->first, 27, 1) << "seed " << seed;
    }
}

TEST(DynamicResolution, DecisionSaysWhyAndWithWhatNumbers) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::Slope), 8);
    Decision switched;
    for (int n = 1; n <= 27; ++n) {
        resolution.addFrame(n, paperMs(n, 0));
        switched = resolution.decide({n, 0});
    }
    ASSERT_TRUE(switched.changed);
    EXPECT_EQ(switched.level, 1);
    ASSERT_TRUE(switched.ratio && switched.rawRatio);
    EXPECT_GT(switched.ratio->low, 1.5);
    EXPECT_NEAR(switched.ratio->value, 500.0 / 81.0, 1.0);
    EXPECT_NEAR(*switched.rawRatio, 1.0, 1e-9); // 26 to 27 is as steep as 25 to 26
    EXPECT_NE(switched.reason.find("after N = 25"), std::string::npos) << switched.reason;
    EXPECT_NE(switched.reason.find("level 1"), std::string::npos) << switched.reason;
}

TEST(DynamicResolution, FinerLevelComesBackBelowFourFifthsOfTheBreak) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::Slope), 8);
    (void)changesWhileGrowing(resolution, 40, 0.0);
    ASSERT_EQ(resolution.level(), 1);
    for (int n = 39; n > 20; --n)
        EXPECT_EQ(resolution.decide({n, 0}).level, 1) << n;
    EXPECT_EQ(resolution.decide({20, 0}).level, 0); // 0.8 x 25
    EXPECT_EQ(resolution.decide({24, 0}).level, 0);
    EXPECT_FALSE(resolution.decide({25, 0}).changed);
    // The curve is still known: no need to suffer the bend twice.
    EXPECT_EQ(resolution.decide({27, 0}).level, 1);
}

TEST(DynamicResolution, ForgottenTimesKeepTheLevelAndItsLimits) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::Slope), 8);
    (void)changesWhileGrowing(resolution, 40, 0.0);
    resolution.forgetTimes();
    EXPECT_EQ(resolution.decide({40, 0}).level, 1);
    EXPECT_EQ(resolution.decide({20, 0}).level, 0);
    EXPECT_EQ(resolution.decide({40, 0}).level, 0); // nothing measured: nothing decided
    resolution.restart();
    EXPECT_EQ(resolution.level(), 0);
    EXPECT_FALSE(resolution.lastNOfLevel()[0]);
}

TEST(DynamicResolution, CoarsestLevelIsTheEnd) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::Slope), 1);
    EXPECT_TRUE(changesWhileGrowing(resolution, 40, 0.0).empty());
    const auto decision = resolution.decide({40, 0});
    EXPECT_EQ(decision.level, 0);
    EXPECT_NE(decision.reason.find("no coarser level"), std::string::npos) << decision.reason;
}

TEST(DynamicResolution, OffStays) {
    DynamicResolution resolution(ruleOf(ResolutionCriterion::Off), 8);
    EXPECT_TRUE(changesWhileGrowing(resolution, 64, 0.0).empty());
}

TEST(DynamicResolution, FrameTimeWithHysteresis) {
    auto rule = ruleOf(ResolutionCriterion::Time);
    rule.frameMs = 300.0;
    DynamicResolution resolution(rule, 8);
    const auto told = [&](int n, double ms) {
        for (int frame = 0; frame < 6; ++frame)
            resolution.addFrame(n, ms);
        return resolution.decide({n, 0});
    };
    EXPECT_EQ(told(4, 240.0).level, 0);
    EXPECT_EQ(told(5, 300.0).level, 0);
    EXPECT_EQ(told(6, 360.0).level, 1);
    EXPECT_EQ(told(6, 90.0).level, 1); // at level 0 it was 360
    EXPECT_EQ(resolution.decide({6, 0}).level, 1);
    EXPECT_EQ(told(5, 75.0).level, 1); // 300 at level 0: not well below
    EXPECT_EQ(told(4, 60.0).level, 1); // 240 = 0.8 x 300: not below
    EXPECT_EQ(told(3, 45.0).level, 0); // the line of level 0 gives 180
}

TEST(DynamicResolution, TimesThatFallAtTheSameNGoBackUp) {
    auto rule = ruleOf(ResolutionCriterion::Time);
    rule.frameMs = 300.0;
    DynamicResolution resolution(rule, 8);
    for (int frame = 0; frame < 6; ++frame)
        resolution.addFrame(6, 360.0);
    ASSERT_EQ(resolution.decide({6, 0}).level, 1);
    resolution.forgetTimes(); // another style
    for (int frame = 0; frame < 6; ++frame)
        resolution.addFrame(6, 29.0);
    EXPECT_EQ(resolution.decide({6, 0}).level, 0); // eight times as long at most: 232
}

TEST(DynamicResolution, BusyMachineKeepsTheOldState) {
    auto rule = ruleOf(ResolutionCriterion::Time);
    rule.frameMs = 300.0;
    DynamicResolution resolution(rule, 8);
    for (const double ms : {280.0, 290.0, 310.0, 800.0, 305.0, 900.0})
        resolution.addFrame(6, ms);
    EXPECT_EQ(resolution.decide({6, 0}).level, 0); // the median is 307.5, but may well be 280
}

TEST(DynamicResolution, FrameRateIsItsInverse) {
    auto rule = ruleOf(ResolutionCriterion::Rate);
    rule.framesPerSecond = 10.0;
    DynamicResolution resolution(rule, 8);
    resolution.addFrame(1, 99.0);
    EXPECT_EQ(resolution.decide({1, 0}).level, 0);
    resolution.addFrame(2, 101.0);
    EXPECT_EQ(resolution.decide({2, 0}).level, 1);
}

TEST(DynamicResolution, CountAndBytesGoStraightToTheirLevel) {
    auto rule = ruleOf(ResolutionCriterion::Count);
    rule.datasets = 10;
    DynamicResolution byCount(rule, 8);
    EXPECT_EQ(byCount.decide({10, 0}).level, 0);
    EXPECT_EQ(byCount.decide({11, 0}).level, 1);
    EXPECT_EQ(byCount.decide({9, 0}).level, 1); // above 0.8 x 10
    EXPECT_EQ(byCount.decide({8, 0}).level, 0);
    EXPECT_EQ(byCount.decide({641, 0}).level, 3);

    rule.criterion = ResolutionCriterion::Bytes;
    rule.bytes = 1000;
    DynamicResolution byBytes(rule, 2);
    EXPECT_EQ(byBytes.decide({1, 1000}).level, 0);
    EXPECT_EQ(byBytes.decide({1, 1'000'000}).level, 1); // there is no coarser one
    EXPECT_EQ(byBytes.decide({1, 900}).level, 1);
    EXPECT_EQ(byBytes.decide({1, 800}).level, 0);
    EXPECT_EQ(byBytes.decide({0, 0}).level, 0);
}

TEST(DynamicResolution, ChangedRuleStartsFromTheLevelThatIsDrawn) {
    auto rule = ruleOf(ResolutionCriterion::Count);
    rule.datasets = 1;
    DynamicResolution resolution(rule, 8);
    ASSERT_EQ(resolution.decide({64, 0}).level, 2);
    resolution.setRule(ruleOf(ResolutionCriterion::Slope));
    EXPECT_EQ(resolution.decide({64, 0}).level, 1); // one level at a time: each is measured
    EXPECT_EQ(resolution.decide({64, 0}).level, 0);
    resolution.setRule(rule);
    ASSERT_EQ(resolution.decide({64, 0}).level, 2);
    resolution.setLevels(2);
    EXPECT_EQ(resolution.level(), 1);
}

TEST(DynamicResolution, BadRulesAreRefused) {
    for (const auto& spoil : std::vector<void (*)(ResolutionRule&)>{
             [](ResolutionRule& rule) { rule.frameMs = 0.0; },
             [](ResolutionRule& rule) { rule.framesPerSecond = -1.0; },
             [](ResolutionRule& rule) { rule.datasets = 0; }, [](ResolutionRule& rule) { rule.bytes = 0; },
             [](ResolutionRule& rule) { rule.upFraction = 1.5; }}) {
        ResolutionRule rule;
        spoil(rule);
        EXPECT_THROW(DynamicResolution(rule, 4), InvalidInput);
    }
    EXPECT_THROW(DynamicResolution({}, 0), InvalidInput);
}

TEST(DynamicResolution, CriteriaHaveNamesBothWays) {
    for (const char* name : {"off", "slope", "slope-first", "time", "rate", "count", "bytes"}) {
        const auto criterion = resolutionCriterionFromName(name);
        ASSERT_TRUE(criterion) << name;
        EXPECT_STREQ(resolutionCriterionName(*criterion), name);
    }
    EXPECT_FALSE(resolutionCriterionFromName("fast"));
}

} // namespace
} // namespace voxsheet
