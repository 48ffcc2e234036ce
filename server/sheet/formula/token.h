// Formula text into tokens.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::sheet {

enum class TokenKind {
    Number,
    Word,        ///< letters, digits, '_', '.', beginning with a letter or '_': a function, a cell or a sheet
    QuotedSheet, ///< 'My sheet', text without the quotes
    BrokenReference, ///< #REF!
    Plus,
    Minus,
    Star,
    Slash,
    Open,
    Close,
    Comma,
    Colon,
    Bang,
    Unknown, ///< a character that no formula has
    End,
};

struct Token {
    TokenKind kind = TokenKind::End;
    std::size_t begin = 0; ///< byte offset into the formula's text
    std::size_t end = 0;
    std::string text;    ///< Word, QuotedSheet, Unknown
    double number = 0.0; ///< Number, finite
};

/// The text includes the leading '='. Always ends with an End token. A number that is out of range is
/// Unknown.
[[nodiscard]] std::vector<Token> tokenizeFormula(std::string_view text);

} // namespace voxsheet::sheet
