#include "resolution/interactive_quality.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

/// A machine that needs `msPerPixel` per full-quality pixel.
double drawn(double msPerPixel, double pixels, int step) {
    return 2.0 + msPerPixel * pixels * kQualitySteps[step].relativeWork();
}

TEST(InteractiveQuality, StepsGetCheaper) {
    for (int step = 1; step < kQualityStepCount; ++step)
        EXPECT_LT(kQualitySteps[step].relativeWork(), kQualitySteps[step - 1].relativeWork());
}

TEST(InteractiveQuality, FastMachineReachesFullQuality) {
    InteractiveQuality quality(60.0);
    int step = quality.choose(600e3);
    for (int frame = 0; frame < 20; ++frame) {
        quality.measured(600e3, step, drawn(1e-6, 600e3, step));
        step = quality.choose(600e3);
    }
    EXPECT_EQ(step, 0);
}

TEST(InteractiveQuality, SlowMachineStaysWithinBudget) {
    InteractiveQuality quality(60.0);
    const double cost = 200.0 / 600e3; // 200 ms at full quality
    int step = quality.choose(600e3);
    for (int frame = 0; frame < 20; ++frame) {
        quality.measured(600e3, step, drawn(cost, 600e3, step));
        step = quality.choose(600e3);
    }
    EXPECT_LE(drawn(cost, 600e3, step), 60.0);
    EXPECT_LE(step, 3) << "coarser than the budget asks for";
}

TEST(InteractiveQuality, FixedCostDoesNotHoldItAtTheCoarsestStep) {
    // 12 ms of every frame do not depend on its pixels: a model without them would never dare a finer step.
    InteractiveQuality quality(60.0);
    const double cost = 60.0 / 600e3;
    int step = kQualityStepCount - 1;
    for (int frame = 0; frame < 30; ++frame) {
        quality.measured(600e3, step, 12.0 + drawn(cost, 600e3, step));
        step = quality.choose(600e3);
    }
    EXPECT_LE(step, 1);
}

TEST(InteractiveQuality, SteadyTimesDoNotFlicker) {
    InteractiveQuality quality(60.0);
    const double cost = 110.0 / 600e3;
    int step = quality.choose(600e3);
    int changes = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const double noise = (frame % 2 == 0) ? 1.1 : 0.9;
        quality.measured(600e3, step, drawn(cost, 600e3, step) * noise);
        const int next = quality.choose(600e3);
        if (frame > 10 && next != step) ++changes;
        step = next;
    }
    EXPECT_LE(changes, 1);
}

TEST(InteractiveQuality, CoarseStepsThatSaveNothingAreNotDrawn) {
    // 64 tiny tiles: 150 ms of every frame go into tiles as such, 15 ms into pixels.
    InteractiveQuality quality(50.0);
    int step = quality.choose(200e3);
    int coarse = 0;
    int changes = 0;
    for (int frame = 0; frame < 240; ++frame) {
        const double noise = (frame % 2 == 0) ? 1.04 : 0.96;
        quality.measured(200e3, step, (150.0 + drawn(15.0 / 200e3, 200e3, step)) * noise);
        const int next = quality.choose(200e3);
        if (frame > 10) {
            coarse += next > 3;
            changes += next != step;
        }
        step = next;
    }
    EXPECT_EQ(coarse, 0);
    EXPECT_LE(changes, 2);
}

TEST(InteractiveQuality, CoarseStepsThatSaveMuchAreDrawnEvenBeyondTheBudget) {
    InteractiveQuality quality(50.0);
    int step = quality.choose(2000e3);
    for (int frame = 0; frame < 30; ++frame) {
        quality.measured(2000e3, step, drawn(3000.0 / 2000e3, 2000e3, step));
        step = quality.choose(2000e3);
    }
    EXPECT_EQ(step, kQualityStepCount - 1);
}

TEST(InteractiveQuality, SlowFirstFramesAreNotTheCostOfTheirStep) {
    // Even the coarsest step is above the budget, but takes a quarter of the time. Its first frames make what
    // all later ones find ready.
    InteractiveQuality quality(50.0);
    const auto costs = [](int step) { return 60.0 + 180.0 * kQualitySteps[step].relativeWork(); };
    for (int frame = 0; frame < 3; ++frame)
        quality.measured(1000e3, 0, costs(0));
    for (int frame = 0; frame < 20; ++frame) {
        const int step = quality.choose(1000e3);
        quality.measured(1000e3, step, frame < 2 ? 600.0 : costs(step));
    }
    EXPECT_EQ(quality.choose(1000e3), kQualityStepCount - 1);
}

TEST(InteractiveQuality, OneHeldUpFrameChangesNothing) {
    InteractiveQuality quality(50.0);
    int step = quality.choose(600e3);
    for (int frame = 0; frame < 60; ++frame) {
        quality.measured(600e3, step, frame % 20 == 19 ? 200.0 : drawn(45.0 / 600e3, 600e3, step));
        step = quality.choose(600e3);
        if (frame > 10) {
            EXPECT_EQ(step, 0) << frame;
        }
    }
}

TEST(InteractiveQuality, MorePixelsMeanACoarserStep) {
    InteractiveQuality quality(60.0);
    quality.measured(100e3, 0, 55.0);
    const int few = quality.choose(100e3);
    const int many = quality.choose(2000e3);
    EXPECT_GT(many, few);
}

} // namespace
} // namespace voxsheet
