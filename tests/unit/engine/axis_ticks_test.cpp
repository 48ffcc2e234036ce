#include "engine/axis_ticks.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

TransferFunction over(double low, double high, ValueScale scale = ValueScale::Linear) {
    TransferFunction function;
    function.low = low;
    function.high = high;
    function.scale = scale;
    return function;
}

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
    std::vector<std::string> texts;
    for (const Tick& tick : ticks)
        texts.push_back(tick.label);
    return texts;
}

TEST(AxisTicks, RoundNumbersInsideTheRange) {
    EXPECT_EQ(labels(axisTicks(over(0, 255), 5)), (std::vector<std::string>{"0", "100", "200"}));
    EXPECT_EQ(labels(axisTicks(over(-1, 1), 4)),
              (std::vector<std::string>{"-1.0", "-0.5", "0", "0.5", "1.0"}));
}

TEST(AxisTicks, ARangeThatJustMissesRoundEndsIsDividedMoreFinely) {
    EXPECT_EQ(labels(axisTicks(over(2e-5, 0.99998), 4)),
              (std::vector<std::string>{"0.2", "0.4", "0.6", "0.8"}));
}

TEST(AxisTicks, PowersOfTenOnALogScale) {
    EXPECT_EQ(labels(axisTicks(over(0.01, 100, ValueScale::Log), 5)),
              (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
}

TEST(AxisTicks, BothSignsAndZeroOnASymmetricLogScale) {
    const auto ticks = axisTicks(over(-100, 100, ValueScale::SymLog), 7);
    bool negative = false;
    bool zero = false;
    bool positive = false;
    for (const Tick& tick : ticks) {
        negative = negative || tick.value < 0;
        zero = zero || tick.value == 0;
        positive = positive || tick.value > 0;
    }
    EXPECT_TRUE(negative && zero && positive);
}

TEST(AxisTicks, AlwaysSortedInsideAndNeverTooMany) {
    for (const ValueScale scale : {ValueScale::Linear, ValueScale::Log, ValueScale::SymLog}) {
        for (const auto& [low, high] :
             {std::pair{0.0, 1e-12}, {1.0, 1.0000001}, {-3.7e20, 4.4e21}, {5.0, 7.0}, {0.1, 2.0}}) {
            const auto ticks = axisTicks(over(low, high, scale), 5);
            ASSERT_GE(ticks.size(), 2U);
            ASSERT_LE(ticks.size(), 15U);
            for (std::size_t i = 0; i < ticks.size(); ++i) {
                EXPECT_TRUE(ticks[i].position >= 0 && ticks[i].position <= 1);
                if (i > 0) {
                    EXPECT_GT(ticks[i].position, ticks[i - 1].position) << low << " " << high;
                }
            }
        }
    }
}

TEST(NumberLabel, ShortAndDistinct) {
    EXPECT_EQ(numberLabel(0.25, 0.05), "0.25");
    EXPECT_EQ(numberLabel(1500, 500), "1500");
    EXPECT_EQ(numberLabel(-0.000012, 0.000001), "-1.2e-5");
    EXPECT_EQ(numberLabel(2e9, 1e9), "2e9");
    EXPECT_EQ(numberLabel(0, 1), "0");
}

} // namespace
} // namespace voxsheet::engine
