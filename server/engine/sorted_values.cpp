#include "engine/sorted_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace voxsheet::engine {

namespace {

constexpr std::size_t kFewValues = 4096; ///< comparing is faster below
constexpr int kDigitBits = 11;
constexpr int kDigits = 3; ///< of 11 bits hold a float's 32
constexpr std::uint32_t kDigitMask = (1U << kDigitBits) - 1;
constexpr std::uint32_t kSign = 1U << 31U;

/// Numbers that are in the order of the floats.
std::uint32_t keyOf(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

float valueOf(std::uint32_t key) { return std::bit_cast<float>((key & kSign) != 0 ? key & ~kSign : ~key); }

std::size_t digitOf(std::uint32_t key, int digit) { return (key >> (digit * kDigitBits)) & kDigitMask; }

/// Radix sort from the lowest digit up; the digits of all passes are counted in one.
void sortByDigits(std::vector<float>& values) {
    std::vector<std::uint32_t> keys(values.size());
    std::array<std::array<std::uint32_t, 1U << kDigitBits>, kDigits> places{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        keys[i] = keyOf(values[i]);
        for (int digit = 0; digit < kDigits; ++digit)
            ++places[static_cast<std::size_t>(digit)][digitOf(keys[i], digit)];
    }
    std::vector<std::uint32_t> sorted(values.size());
    for (int digit = 0; digit < kDigits; ++digit) {
        auto& next = places[static_cast<std::size_t>(digit)];
        std::uint32_t begin = 0;
        for (std::uint32_t& place : next)
            begin += std::exchange(place, begin);
        for (const std::uint32_t key : keys)
            sorted[next[digitOf(key, digit)]++] = key;
        keys.swap(sorted);
    }
    std::transform(keys.begin(), keys.end(), values.begin(), valueOf);
}

} // namespace

void sortFinite(std::vector<float>& values) {
    std::erase_if(values, [](float value) { return !std::isfinite(value); });
    for (float& value : values)
        value += 0.0F; // -0 + 0 is 0
    if (values.size() < kFewValues)
        std::sort(values.begin(), values.end());
    else
        sortByDigits(values);
}

} // namespace voxsheet::engine
