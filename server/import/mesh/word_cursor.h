// Words and numbers of a text in memory, with the line they are on.
#pragma once

#include "import/formats/number_text.h"

#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::import {

class WordCursor {
public:
    explicit WordCursor(std::string_view text) : rest_(text) {}

    /// The next word, over line ends; empty at the end of the text.
    [[nodiscard]] std::string_view word();
    /// The next number; nullopt if the next word is none.
    [[nodiscard]] std::optional<double> number() { return parseNumber(word()); }
    /// The rest of the line, without its end; the cursor moves to the next line.
    [[nodiscard]] std::string_view line();
    [[nodiscard]] bool atEnd() const { return rest_.empty(); }
    [[nodiscard]] std::string_view rest() const { return rest_; }

    /// "line 12": of the word or line that was read last.
    [[nodiscard]] std::string place() const { return "line " + std::to_string(wordLine_); }

private:
    std::string_view rest_;
    long line_ = 1;
    long wordLine_ = 1;
};

} // namespace voxsheet::import
