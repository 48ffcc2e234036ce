#include "engine/axis_ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace voxsheet::engine {

namespace {

double roundStep(double step) {
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= step * (1.0 - 1e-9)) return factor * power;
    }
    return 10.0 * power;
}

void addTick(std::vector<Tick>& ticks, const TransferFunction& function, double value, double resolution) {
    const double position = transferPosition(function, value);
    if (position < -1e-9 || position > 1.0 + 1e-9) return;
    ticks.push_back({std::clamp(position, 0.0, 1.0), value, numberLabel(value, resolution)});
}

std::vector<Tick> ticksAtStep(const TransferFunction& function, int wanted, double step) {
    std::vector<Tick> ticks;
    const double first = std::ceil(function.low / step - 1e-9);
    for (double k = first; k * step <= function.high + 1e-9 * step; k += 1.0) {
        addTick(ticks, function, k * step == 0.0 ? 0.0 : k * step, step);
        if (ticks.size() >= static_cast<std::size_t>(2 * wanted)) break;
    }
    return ticks;
}

std::vector<Tick> linearTicks(const TransferFunction& function, int wanted) {
    // A range that just misses round ends, such as 0.001 to 0.999, may hold but one multiple of the first
    // step.
    const double span = function.high - function.low;
    std::vector<Tick> ticks;
    for (const double part : {1.0, 2.0, 4.0}) {
        ticks = ticksAtStep(function, wanted, roundStep(span / (part * wanted)));
        if (ticks.size() >= 2) break;
    }
    return ticks;
}

/// Powers of ten between two positive magnitudes, thinned out to `wanted`.
std::vector<double> decades(double low, double high, int wanted) {
    const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
    const int stride = std::max(1, (last - first + wanted) / wanted);
    std::vector<double> values;
    for (int power = first; power <= last; power += stride)
        values.push_back(std::pow(10.0, power));
    return values;
}

std::vector<Tick> logTicks(const TransferFunction& function, int wanted) {
    std::vector<Tick> ticks;
    for (const double value : decades(transferValue(function, 0.0), function.high, wanted)) {
        addTick(ticks, function, value, value);
    }
    return ticks;
}

std::vector<Tick> symLogTicks(const TransferFunction& function, int wanted) {
    const double largest = std::max(std::abs(function.low), std::abs(function.high));
    const double threshold = function.symLogThreshold > 0.0 ? function.symLogThreshold : 1e-3 * largest;
    std::vector<Tick> ticks;
    const auto magnitudes = decades(threshold, largest, std::max(2, wanted / 2));
    for (auto m = magnitudes.rbegin(); m != magnitudes.rend(); ++m)
        addTick(ticks, function, -*m, *m);
    addTick(ticks, function, 0.0, threshold);
    for (const double m : magnitudes)
        addTick(ticks, function, m, m);
    return ticks;
}

} // namespace

std::vector<Tick> axisTicks(const TransferFunction& function, int wanted) {
    wanted = std::clamp(wanted, 2, 50);
    std::vector<Tick> ticks;
    switch (function.scale) {
    case ValueScale::Linear:
        ticks = linearTicks(function, wanted);
        break;
    case ValueScale::Log:
        ticks = logTicks(function, wanted);
        break;
    case ValueScale::SymLog:
        ticks = symLogTicks(function, wanted);
        break;
    }
    if (ticks.size() < 2) {
        ticks.clear();
        const double low = transferValue(function, 0.0);
        const double resolution = (function.high - low) / 100.0;
        addTick(ticks, function, low, resolution);
        addTick(ticks, function, function.high, resolution);
    }
    return ticks;
}

std::string numberLabel(double value, double resolution) {
    if (value == 0.0) return "0";
    const double magnitude = std::abs(value);
    const double step = resolution > 0.0 && std::isfinite(resolution) ? resolution : magnitude;
    std::array<char, 64> text{};
    if (magnitude >= 1e6 || magnitude < 1e-3) {
        const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(magnitude / step) - 1e-9)), 0, 6);
        std::snprintf(text.data(), text.size(), "%.*e", digits, value);
        std::string label = text.data();
        // "1.50e+06" -> "1.5e6"
        const auto e = label.find('e');
        std::string mantissa = label.substr(0, e);
        if (mantissa.find('.') != std::string::npos) {
            mantissa.erase(mantissa.find_last_not_of('0') + 1);
            if (mantissa.back() == '.') mantissa.pop_back();
        }
        return mantissa + "e" + std::to_string(std::stoi(label.substr(e + 1)));
    }
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

} // namespace voxsheet::engine
