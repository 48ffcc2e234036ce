#include "import/vtk_legacy/text_cursor.h"

#include "base/errors.h"
#include "import/formats/number_batch.h"
#include "import/formats/number_text.h"

namespace voxsheet::import {

namespace {

constexpr std::size_t kBufferBytes = 256 * 1024;
constexpr std::size_t kLongestLine = 4096;

} // namespace

bool TextCursor::fill() {
    if (position_ >= bufferStart_ && position_ < bufferStart_ + buffer_.size()) return true;
    bufferStart_ = position_;
    buffer_ = file_.textAt(position_, kBufferBytes);
    return !buffer_.empty();
}

std::optional<std::string> TextCursor::line() {
    if (!fill()) return std::nullopt;
    std::string text;
    while (fill()) {
        const char c = buffer_[position_ - bufferStart_];
        ++position_;
        if (c == '\n') break;
        text += c;
        if (text.size() > kLongestLine)
            throw InvalidInput(file_.name(), "a line of its header is longer than " +
                                                 std::to_string(kLongestLine) + " bytes");
    }
    if (text.ends_with('\r')) text.pop_back();
    return text;
}

std::optional<std::string> TextCursor::lineWithText() {
    while (auto text = line())
        if (!trimmed(*text).empty()) return text;
    return std::nullopt;
}

bool TextCursor::skipBytes(std::uint64_t count) {
    if (count > file_.bytes() - std::min(position_, file_.bytes())) return false;
    position_ += count;
    return true;
}

bool TextCursor::skipWords(std::uint64_t count) {
    bool inWord = false;
    while (count > 0 && fill()) {
        auto at = static_cast<std::size_t>(position_ - bufferStart_);
        for (; at < buffer_.size(); ++at) {
            const bool blank = isTextBlank(buffer_[at]);
            if (inWord && blank && --count == 0) break;
            inWord = !blank;
        }
        position_ = bufferStart_ + at;
    }
    return count == 0 || (inWord && count == 1);
}

} // namespace voxsheet::import
