// Remembers what was found of ranges: bricks of a volume share few, so most questions were asked before.
// Private to this room.
#pragma once

#include "volume/min_max_grid.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace voxsheet {

/// Of one thread. A range that falls on another's place takes it.
template <typename Answer>
class RangeMemo {
public:
    /// answerTo(range), asked once for ranges that were not pushed out since.
    template <typename AnswerTo>
    Answer operator()(const MinMaxGrid::Range& range, const AnswerTo& answerTo) {
        const auto low = std::bit_cast<std::uint32_t>(range.low);
        const auto high = std::bit_cast<std::uint32_t>(range.high);
        const std::uint64_t key = (std::uint64_t{high} << 32) | low;
        Place& place = places_[static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> 54)];
        if (!place.answer || place.key != key) place = {key, answerTo(range)};
        return *place.answer;
    }

private:
    struct Place {
        std::uint64_t key = 0;
        std::optional<Answer> answer;
    };
    std::array<Place, 1024> places_{};
};

} // namespace voxsheet
