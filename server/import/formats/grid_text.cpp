#include "import/formats/grid_text.h"

#include "base/errors.h"
#include "import/formats/number_text.h"

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

double GridValues::next() {
    const auto word = text_.word();
    if (word.empty())
        throw InvalidInput(
            name_, "it ends after " + std::to_string(done_) + " of " + std::to_string(count_) + " values",
            "copy the file again, or let the calculation finish");
    const auto value = parseFortranNumber(word);
    if (!value)
        throw InvalidInput(name_, "it holds '" + printable(word) + "' where value " +
                                      std::to_string(done_ + 1) + " of a grid should be");
    const bool sign = word[0] == '-' || word[0] == '+';
    const auto width = word.size() - (sign ? 1 : 0);
    if (++done_ == count_ && equallyWide_ && width < width_ && text_.atEnd())
        throw InvalidInput(name_, "it ends within the last value of a grid", "copy the file again");
    if (width_ != 0 && width != width_) equallyWide_ = false;
    width_ = width;
    return *value;
}

} // namespace voxsheet::import
