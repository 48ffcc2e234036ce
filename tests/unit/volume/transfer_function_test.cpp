#include "volume/transfer_function.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace voxsheet {
namespace {

TransferFunction greyRamp(double low, double high) {
    TransferFunction function;
    function.colours = {{0.0, glm::dvec3(0.0)}, {1.0, glm::dvec3(1.0)}};
    function.opacities = {{0.0, 0.0}, {1.0, 0.5}};
    function.low = low;
    function.high = high;
    return function;
}

TEST(TransferFunction, PiecewiseIsLinearBetweenPointsAndHoldsBeyondTheEnds) {
    auto function = greyRamp(10.0, 20.0);
    function.opacities = {{0.25, 0.2}, {0.5, 0.6}};
    EXPECT_DOUBLE_EQ(evaluateTransfer(function, 10.0).w, 0.2);
    EXPECT_DOUBLE_EQ(evaluateTransfer(function, 13.75).w, 0.4);
    EXPECT_DOUBLE_EQ(evaluateTransfer(function, 19.0).w, 0.6);
    EXPECT_NEAR(evaluateTransfer(function, 13.0).x, 0.3, 1e-12);
}

TEST(TransferFunction, TwoPointsAtOnePositionMakeAStep) {
    auto function = greyRamp(0.0, 1.0);
    function.opacities = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.8}, {1.0, 0.8}};
    EXPECT_DOUBLE_EQ(evaluateTransfer(function, std::nextafter(0.5, 0.0)).w, 0.0);
    EXPECT_DOUBLE_EQ(evaluateTransfer(function, 0.5).w, 0.8);
}

TEST(TransferFunction, LinearShapeMatchesItsFormula) {
    auto function = greyRamp(0.0, 1.0);
    function.shape = TransferShape::Linear;
    function.cut1 = 0.2;
    function.cut2 = 0.6;
    EXPECT_EQ(glm::dvec3(evaluateTransfer(function, 0.1)), glm::dvec3(0, 0, 1));
    EXPECT_EQ(glm::dvec3(evaluateTransfer(function, 0.9)), glm::dvec3(1, 0, 0));
    const auto quarter = evaluateTransfer(function, 0.3);
    EXPECT_NEAR(quarter.z, 0.5, 1e-12);
    EXPECT_NEAR(quarter.y, 0.5, 1e-12);
    EXPECT_NEAR(evaluateTransfer(function, 0.4).y, 1.0, 1e-12);
}

TEST(TransferFunction, EveryShapeSumsToOneAndRisesFromBlueToRed) {
    for (const auto shape : {TransferShape::Linear, TransferShape::Exponential, TransferShape::Parabolic}) {
        auto function = greyRamp(-1.0, 3.0);
        function.shape = shape;
        double red = -1.0;
        for (double value = -1.0; value <= 3.0; value += 0.01) {
            const auto rgba = evaluateTransfer(function, value);
            EXPECT_NEAR(rgba.x + rgba.y + rgba.z, 1.0, 1e-12);
            EXPECT_GE(rgba.x, red);
            EXPECT_GE(rgba.y, 0.0);
            red = rgba.x;
        }
    }
    auto function = greyRamp(0.0, 1.0);
    function.shape = TransferShape::Parabolic;
    EXPECT_NEAR(evaluateTransfer(function, 0.375).y, 0.25, 1e-12);
    function.shape = TransferShape::Exponential;
    EXPECT_NEAR(evaluateTransfer(function, 0.375).y, std::expm1(1.5) / std::expm1(3.0), 1e-12);
}

TEST(TransferFunction, PositionAndValueAreInverse) {
    for (const auto scale : {ValueScale::Linear, ValueScale::Log, ValueScale::SymLog}) {
        auto function = greyRamp(scale == ValueScale::Log ? 1e-4 : -50.0, 200.0);
        function.scale = scale;
        double previous = -1.0;
        for (double position = 0.0; position <= 1.0; position += 1.0 / 64) {
            const double value = transferValue(function, position);
            EXPECT_NEAR(transferPosition(function, value), position, 1e-12);
            EXPECT_GT(position, previous);
            previous = position;
        }
        EXPECT_LT(transferPosition(function, function.low - 1.0), 0.0);
        EXPECT_GT(transferPosition(function, 201.0), 1.0);
    }
}

TEST(TransferFunction, LogOfARangeThatStartsAtZeroSpansSixDecades) {
    auto function = greyRamp(0.0, 1000.0);
    function.scale = ValueScale::Log;
    EXPECT_NEAR(transferPosition(function, 1000.0 * 1e-3), 0.5, 1e-12);
    EXPECT_LT(transferPosition(function, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(buildTransferTable(function)->low, 1000.0 * 1e-6);
}

TEST(TransferFunction, SymLogIsLinearInsideTheThresholdAndOdd) {
    auto function = greyRamp(-100.0, 100.0);
    function.scale = ValueScale::SymLog;
    function.symLogThreshold = 2.0;
    EXPECT_NEAR(transferPosition(function, 0.0), 0.5, 1e-12);
    const double unit = transferPosition(function, 1.0) - 0.5;
    EXPECT_NEAR(transferPosition(function, 2.0) - 0.5, 2.0 * unit, 1e-12);
    EXPECT_NEAR(transferPosition(function, -37.0), 1.0 - transferPosition(function, 37.0), 1e-12);
}

TEST(TransferFunction, OutsideColoursAndNan) {
    auto function = greyRamp(0.0, 1.0);
    function.nan = {1, 0, 1, 0.25};
    EXPECT_DOUBLE_EQ(evaluateTransfer(function, 2.0).w, 0.5);
    function.hasBelow = function.hasAbove = true;
    function.below = {0, 1, 0, 0.75};
    function.above = {0, 0, 1, 1};
    EXPECT_EQ(evaluateTransfer(function, -1e-9), function.below);
    EXPECT_EQ(evaluateTransfer(function, 1.0 + 1e-9), function.above);
    EXPECT_EQ(evaluateTransfer(function, std::nan("")), function.nan);
    const auto table = buildTransferTable(function);
    EXPECT_EQ(classify(*table, -0.5), function.below);
    EXPECT_EQ(classify(*table, 1.5), function.above);
    EXPECT_EQ(classify(*table, std::nan("")), function.nan);
}

TEST(TransferTable, FollowsTheFunctionOnEveryScale) {
    for (const auto scale : {ValueScale::Linear, ValueScale::Log, ValueScale::SymLog}) {
        auto function = greyRamp(scale == ValueScale::Log ? 1e-3 : -10.0, 1000.0);
        function.scale = scale;
        function.opacities = {{0.1, 0.0}, {0.2, 0.9}, {0.8, 0.1}};
        const auto table = buildTransferTable(function);
        ASSERT_EQ(table->entries.size(), std::size_t(kTransferTableEntries));
        for (int i = 0; i <= 1000; ++i) {
            const double value = transferValue(function, i / 1000.0);
            const auto wanted = evaluateTransfer(function, value);
            const auto got = classify(*table, value);
            for (int c = 0; c < 4; ++c)
                EXPECT_NEAR(got[c], wanted[c], 2e-3) << value;
        }
    }
}

TEST(TransferTable, MaxOpacityBoundsEveryValueInside) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    auto function = greyRamp(0.0, 1.0);
    function.opacities = {{0.30, 0.0}, {0.31, 0.7}, {0.32, 0.0}, {0.9, 0.0}, {0.9, 0.4}};
    const auto table = buildTransferTable(function);
    for (int trial = 0; trial < 200; ++trial) {
        const double low = uniform(random) * 1.4 - 0.2;
        const double high = low + 0.1 * uniform(random);
        const float bound = maxOpacity(*table, low, high);
        for (int i = 0; i <= 20; ++i)
            EXPECT_LE(classify(*table, low + (high - low) * i / 20).w, double(bound) + 1e-7);
    }
    EXPECT_EQ(maxOpacity(*table, 0.35, 0.85), 0.0F);
    EXPECT_EQ(maxOpacity(*table, -5.0, 0.25), 0.0F);
    EXPECT_NEAR(maxOpacity(*table, 0.0, 1.0), 0.7F, 1e-2);
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(maxOpacity(*table, infinity, -infinity), 0.0F);
}

TEST(TransferTable, RefusesWhatItCannotMean) {
    const auto field = [](const std::function<void(TransferFunction&)>& spoil) {
        auto function = greyRamp(0.0, 1.0);
        spoil(function);
        try {
            (void)buildTransferTable(function);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("accepted");
    };
    EXPECT_EQ(field([](TransferFunction&) {}), "accepted");
    EXPECT_EQ(field([](TransferFunction& f) { f.low = 1.0; }), "range.min");
    EXPECT_EQ(field([](TransferFunction& f) { f.high = std::nan(""); }), "range.min");
    EXPECT_EQ(field([](TransferFunction& f) { f.colours.clear(); }), "transfer.points");
    EXPECT_EQ(field([](TransferFunction& f) { f.colours[0].rgb.y = 1.5; }), "transfer.points");
    EXPECT_EQ(field([](TransferFunction& f) { f.opacities.clear(); }), "transfer.opacity");
    EXPECT_EQ(field([](TransferFunction& f) { f.opacities = {{0.5, 0.1}, {0.4, 0.1}}; }), "transfer.opacity");
    EXPECT_EQ(field([](TransferFunction& f) { f.opacities[0].opacity = -0.1; }), "transfer.opacity");
    EXPECT_EQ(field([](TransferFunction& f) {
                  f.shape = TransferShape::Linear;
                  f.cut1 = f.cut2;
              }),
              "transfer.cut1");
    EXPECT_EQ(field([](TransferFunction& f) {
                  f.scale = ValueScale::Log;
                  f.low = -2.0;
                  f.high = -1.0;
              }),
              "range.scale");
    EXPECT_EQ(field([](TransferFunction& f) {
                  f.hasBelow = true;
                  f.below.w = 2.0;
              }),
              "transfer.belowColor");
}

} // namespace
} // namespace voxsheet
