#include "import/formats/grid_text.h"

#include "base/errors.h"
#include "import/formats/number_text.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::import {

namespace {

/// Programs write a grid in lines of equal length. When a look at the first and at lines spread over the grid
/// confirms this, all but the last line is passed over unread: files can be gigabytes, and readData looks at
/// every value anyway. Returns the number of values passed.
std::uint64_t jumpOverEqualLines(const InputFile& file, TextScanner& text, std::uint64_t values) {
    constexpr std::uint64_t worthwhile = 1'000'000;
    constexpr std::uint64_t probes = 64;
    const auto start = text.position();
    const auto first = file.textAt(start, 1024);
    const auto length = first.find('\n') + 1;
    if (values < worthwhile || length == 0) return 0;
    const auto perLine = splitWords(first.substr(0, length)).size();
    if (perLine == 0) return 0;
    const auto lines = values / perLine - 1;
    if (start + lines * length > file.bytes()) return 0;
    for (std::uint64_t probe = 0; probe <= probes; ++probe) {
        const auto line = file.textAt(start + (lines - 1) * probe / probes * length, length);
        if (line.find('\n') + 1 != length || splitWords(line).size() != perLine) return 0;
    }
    text.skipBytes(lines * length);
    return lines * perLine;
}

} // namespace

TextScanner openText(const InputFile& file) {
    return {openStream(file, 0, compressionOf(file.textAt(0, 4))), file.name()};
}

std::optional<glm::dvec3> leadingVector(std::string_view line) {
    const auto words = splitWords(line);
    if (words.size() < 3) return std::nullopt;
    glm::dvec3 vector;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto number = parseFortranNumber(words[static_cast<std::size_t>(axis)]);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        vector[axis] = *number;
    }
    return vector;
}

void checkTextHolds(const InputFile& file, std::uint64_t values) {
    const auto longest = largestDecompressedBytes(file.bytes(), compressionOf(file.textAt(0, 4)));
    if (values > longest / 2 + 1)
        throw InvalidInput(file.name(), "its grid of " + std::to_string(values) +
                                            " values cannot be in a file of " + std::to_string(file.bytes()) +
                                            " bytes");
}

void skipGrid(const InputFile& file, TextScanner& text, std::uint64_t values, const std::string& grid) {
    std::uint64_t found = 0;
    if (compressionOf(file.textAt(0, 4)) == Compression::None) found = jumpOverEqualLines(file, text, values);
    constexpr std::uint64_t widestValueBytes = 64;
    constexpr std::uint64_t slackBytes = 1U << 20;
    found += text.skipWords(values - found, (values - found) * widestValueBytes + slackBytes);
    if (found < values)
        throw InvalidInput(file.name(),
                           grid + " needs " + std::to_string(values) + " values, the file ends after " +
                               std::to_string(found),
                           "copy the file again, or let the calculation finish");
}

/// Parses a batch of words; at least one value is ready afterwards.
void GridValues::fetch() {
    constexpr std::uint64_t usualLetters = 32; // a little more than a value and its blank take
    ready_.clear();
    at_ = 0;
    const auto wanted = count_ - done_;
    const auto bytes = std::min<std::uint64_t>(kNumberBatchBytes, wanted * usualLetters);
    for (;;) {
        const auto text = text_.peek(static_cast<std::size_t>(bytes));
        const auto pieces = parsePieces<double>(text, false, parseFortranNumber);
        std::optional<std::string> badWord;
        for (const auto& piece : pieces) {
            add(piece, wanted);
            if (!piece.badWord) continue;
            badWord = printable(*piece.badWord);
            break;
        }
        if (ready_.size() == wanted) { // what follows the grid is not its own
            (void)text_.skipWords(wanted, text.size());
            return checkLastValue();
        }
        const auto value = std::to_string(done_ + ready_.size() + 1);
        if (badWord)
            throw InvalidInput(name_,
                               "it holds '" + *badWord + "' where value " + value + " of a grid should be");
        if (text.empty())
            throw InvalidInput(
                name_, "it ends after " + std::to_string(done_) + " of " + std::to_string(count_) + " values",
                "copy the file again, or let the calculation finish");
        text_.skipBytes(text.size());
        if (!ready_.empty()) return;
    }
}

void GridValues::add(const NumberPiece<double>& piece, std::uint64_t wanted) {
    const auto room = wanted - ready_.size();
    if (piece.values.empty() || room == 0) return;
    const auto taken = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(room, piece.values.size()));
    ready_.insert(ready_.end(), piece.values.begin(), piece.values.begin() + taken);
    // Words beyond the grid count as well: the file does not end then, and nobody asks for widths.
    const auto join = [this](std::size_t width) {
        if (earlierWidth_ != 0 && width != 0 && width != earlierWidth_) equallyWide_ = false;
        if (width != 0) earlierWidth_ = width;
    };
    join(width_);
    join(piece.earlierWidth);
    equallyWide_ = equallyWide_ && piece.equallyWide;
    width_ = piece.width;
}

void GridValues::checkLastValue() {
    if (equallyWide_ && width_ < earlierWidth_ && text_.atEnd())
        throw InvalidInput(name_, "it ends within the last value of a grid", "copy the file again");
}

} // namespace voxsheet::import
