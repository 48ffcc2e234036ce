#include "import/formats/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace voxsheet::import {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

std::string_view withoutPlus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
    return text;
}

/// Out of a double's range: 0 when it is too small, nullopt when it is too large.
std::optional<double> outOfRange(std::string_view text) {
    const auto exponent = text.find_first_of("eE");
    const bool small =
        exponent != std::string_view::npos && exponent + 1 < text.size() && text[exponent + 1] == '-';
    return small ? std::optional<double>(0.0) : std::nullopt;
}

} // namespace

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lowerCase(std::string_view text) {
    std::string result(text);
    for (auto& letter : result)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return result;
}

std::vector<std::string_view> splitWords(std::string_view text) {
    std::vector<std::string_view> words;
    for (auto begin = text.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
        const auto end = std::min(text.find_first_of(kBlanks, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(kBlanks, end);
    }
    return words;
}

std::optional<std::string_view> takeLine(std::string_view& text) {
    if (text.empty()) return std::nullopt;
    const auto end = text.find('\n');
    auto line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::optional<std::int64_t> parseInteger(std::string_view text) {
    text = withoutPlus(text);
    std::int64_t value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<double> parseNumber(std::string_view text) {
    text = withoutPlus(text);
    double value = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) return std::nullopt;
    if (code == std::errc::result_out_of_range) return outOfRange(text);
    if (code != std::errc{}) return std::nullopt;
    return value;
}

std::optional<double> parseFortranNumber(std::string_view text) {
    if (const auto value = parseNumber(text)) return value;
    std::array<char, 64> plain{};
    if (text.size() + 1 > plain.size()) return std::nullopt;
    std::size_t length = 0;
    bool hasExponent = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char letter = text[i];
        if (letter == 'd' || letter == 'D') letter = 'e';
        if (letter == 'e' || letter == 'E') hasExponent = true;
        const bool bareExponent = i > 0 && !hasExponent && (letter == '+' || letter == '-');
        if (bareExponent) {
            plain[length++] = 'e';
            hasExponent = true;
        }
        plain[length++] = letter;
    }
    return parseNumber({plain.data(), length});
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t count) {
    const auto words = splitWords(text);
    if (words.size() != count) return std::nullopt;
    std::vector<double> values;
    for (const auto word : words) {
        const auto value = parseNumber(word);
        if (!value || !std::isfinite(*value)) return std::nullopt;
        values.push_back(*value);
    }
    return values;
}

std::optional<std::vector<std::int64_t>> parseIntegers(std::string_view text, std::size_t count) {
    const auto words = splitWords(text);
    if (words.size() != count) return std::nullopt;
    std::vector<std::int64_t> values;
    for (const auto word : words) {
        const auto value = parseInteger(word);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    return values;
}

} // namespace voxsheet::import
