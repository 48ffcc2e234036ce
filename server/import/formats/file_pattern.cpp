#include "import/formats/file_pattern.h"

#include "import/formats/number_text.h"

#include <cstdint>
#include <cstdlib>

namespace voxsheet::import {

namespace {

struct Conversion {
    std::string_view before;
    std::string_view after;
    std::size_t width = 0;
    bool zeros = false;

    [[nodiscard]] std::string fill(std::int64_t number) const {
        auto digits = std::to_string(number);
        if (digits.size() < width)
            digits.insert(number < 0 && zeros ? 1 : 0, width - digits.size(), zeros ? '0' : ' ');
        return std::string(before) + digits + std::string(after);
    }
};

std::optional<Conversion> parseConversion(std::string_view pattern) {
    const auto percent = pattern.find('%');
    if (percent == std::string_view::npos || pattern.find('%', percent + 1) != std::string_view::npos)
        return std::nullopt;
    const auto letter = pattern.find_first_not_of("0123456789", percent + 1);
    if (letter == std::string_view::npos ||
        std::string_view("diu").find(pattern[letter]) == std::string_view::npos)
        return std::nullopt;
    const auto digits = pattern.substr(percent + 1, letter - percent - 1);
    const auto width = digits.empty() ? std::optional<std::int64_t>(0) : parseInteger(digits);
    if (!width || *width > 32) return std::nullopt;
    return Conversion{pattern.substr(0, percent), pattern.substr(letter + 1),
                      static_cast<std::size_t>(*width), digits.starts_with('0')};
}

} // namespace

std::optional<std::vector<std::string>> expandFilePattern(std::string_view value) {
    const auto words = splitWords(value);
    if (words.size() < 4 || words.size() > 5) return std::nullopt;
    const auto conversion = parseConversion(words[0]);
    const auto first = parseInteger(words[1]);
    const auto last = parseInteger(words[2]);
    const auto step = parseInteger(words[3]);
    if (!conversion || !first || !last || !step || *step == 0) return std::nullopt;
    constexpr std::int64_t farthest = 1'000'000'000;
    if (*first < -farthest || *first > farthest || *last < -farthest || *last > farthest ||
        *step < -farthest || *step > farthest)
        return std::nullopt;
    const auto intervals = (*last - *first) / *step;
    const bool wrongWay = *step > 0 ? *last < *first : *last > *first;
    if (wrongWay || intervals >= static_cast<std::int64_t>(kMostDataFiles)) return std::nullopt;
    std::vector<std::string> names;
    for (std::int64_t index = 0; index <= intervals; ++index)
        names.push_back(conversion->fill(*first + index * *step));
    return names;
}

} // namespace voxsheet::import
