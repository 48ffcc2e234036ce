// The numbers of a stretch of text, parsed by all cores: text formats hold gigabytes of them.
#pragma once

#include "volume/parallel_for.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace voxsheet::import {

constexpr bool isTextBlank(char letter) { return letter == ' ' || (letter >= '\t' && letter <= '\r'); }

/// Text that is worth the cores at once.
inline constexpr std::size_t kNumberBatchBytes = 4U << 20;

/// What one core made of its piece of the text.
template <typename T>
struct NumberPiece {
    std::vector<T> values;                   ///< up to the end, or to the first word that is no number
    std::optional<std::string_view> badWord; ///< that word, when there is one
    std::size_t width = 0;                   ///< letters of the last word, without its sign; 0: there is none
    std::size_t earlierWidth = 0;            ///< the same of the words before the last; 0: there are none
    bool equallyWide = true;                 ///< the words before the last have one width
};

/// \param text    ends where a word ends, and begins where one begins or with blanks
/// \param commas  they are blanks, too
/// \param parse   std::optional<T>(std::string_view word): asked for words that are not plain numbers of T
template <typename T, typename Parse>
NumberPiece<T> parsePiece(std::string_view text, bool commas, const Parse& parse) {
    const auto blank = [commas](char letter) { return isTextBlank(letter) || (commas && letter == ','); };
    constexpr std::size_t usualLetters = 8;
    NumberPiece<T> piece;
    piece.values.reserve(text.size() / usualLetters);
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
        while (at != end && blank(*at))
            ++at;
        if (at == end) return piece;
        const char* const word = at;
        T value{};
        auto [stop, code] = std::from_chars(word, end, value);
        if (code != std::errc{} || (stop != end && !blank(*stop))) {
            for (stop = word; stop != end && !blank(*stop);)
                ++stop;
            const std::string_view letters(word, static_cast<std::size_t>(stop - word));
            const std::optional<T> other = parse(letters);
            if (!other) {
                piece.badWord = letters;
                return piece;
            }
            value = *other;
        }
        piece.values.push_back(value);
        if (piece.width != 0) {
            if (piece.earlierWidth != 0 && piece.earlierWidth != piece.width) piece.equallyWide = false;
            piece.earlierWidth = piece.width;
        }
        const bool sign = *word == '-' || *word == '+';
        piece.width = static_cast<std::size_t>(stop - word) - (sign ? 1U : 0U);
        at = stop;
    }
}

/// The pieces in the text's order; those after one with a bad word mean nothing.
template <typename T, typename Parse>
std::vector<NumberPiece<T>> parsePieces(std::string_view text, bool commas, const Parse& parse) {
    constexpr std::size_t pieceBytes = 256U << 10;
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        auto length = std::min(pieceBytes, text.size());
        while (length < text.size() && !isTextBlank(text[length]))
            ++length;
        parts.push_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    std::vector<NumberPiece<T>> pieces(parts.size());
    parallelFor(static_cast<long>(parts.size()), 1, [&](long begin, long end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
            pieces[i] = parsePiece<T>(parts[i], commas, parse);
    });
    return pieces;
}

} // namespace voxsheet::import
