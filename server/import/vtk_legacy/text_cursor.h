// Walks over a file that mixes lines of text with blocks of binary numbers.
#pragma once

#include "import/formats/input_file.h"

#include <cstdint>
#include <optional>
#include <string>

namespace voxsheet::import {

class TextCursor {
public:
    /// `file` must live as long as the cursor.
    explicit TextCursor(const InputFile& file) : file_(file) {}

    [[nodiscard]] std::uint64_t position() const { return position_; }

    /// The rest of the line, without its end; the cursor moves past the end. nullopt at the end of the file.
    /// Throws InvalidInput if the line is longer than 4096 bytes.
    [[nodiscard]] std::optional<std::string> line();
    /// The next line that is not blank.
    [[nodiscard]] std::optional<std::string> lineWithText();

    /// Moves past a block of bytes; false (and no move) if the file ends before.
    [[nodiscard]] bool skipBytes(std::uint64_t count);
    /// Moves past `count` words between blanks and line ends; false if the file ends before.
    [[nodiscard]] bool skipWords(std::uint64_t count);

private:
    /// Makes at least one byte at the cursor available; false at the end of the file.
    [[nodiscard]] bool fill();

    const InputFile& file_;
    std::uint64_t position_ = 0;
    std::uint64_t bufferStart_ = 0;
    std::string buffer_;
};

} // namespace voxsheet::import
