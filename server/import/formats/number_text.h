// Strict numbers and words out of header text: the whole text must be the number, whatever the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

/// Without blanks, tabs and line ends at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lowerCase(std::string_view text);
/// Pieces between blanks and tabs.
[[nodiscard]] std::vector<std::string_view> splitWords(std::string_view text);
/// The next line of `text`, without "\n" or "\r\n"; removes it from `text`. Empty text gives nullopt.
[[nodiscard]] std::optional<std::string_view> takeLine(std::string_view& text);

/// Decimal integer with an optional sign.
[[nodiscard]] std::optional<std::int64_t> parseInteger(std::string_view text);
/// Decimal number; also "nan" and "inf". Too small for a double gives 0, too large nullopt.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);
/// parseNumber, and Fortran's forms: exponents by D ("1.5D-03"), and without a letter ("0.123-100").
[[nodiscard]] std::optional<double> parseFortranNumber(std::string_view text);

/// All words are finite numbers and there are `count` of them; nullopt otherwise.
[[nodiscard]] std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t count);
[[nodiscard]] std::optional<std::vector<std::int64_t>> parseIntegers(std::string_view text,
                                                                     std::size_t count);

} // namespace voxsheet::import
