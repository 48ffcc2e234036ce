#include "import/mesh/word_cursor.h"

namespace voxsheet::import {

namespace {

bool isBlank(char letter) { return letter == ' ' || (letter >= '\t' && letter <= '\r'); }

} // namespace

std::string_view WordCursor::word() {
    std::size_t begin = 0;
    while (begin < rest_.size() && isBlank(rest_[begin]))
        line_ += rest_[begin++] == '\n' ? 1 : 0;
    std::size_t end = begin;
    while (end < rest_.size() && !isBlank(rest_[end]))
        ++end;
    const auto word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    wordLine_ = line_;
    return word;
}

std::string_view WordCursor::line() {
    const auto end = rest_.find('\n');
    auto line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    wordLine_ = line_++;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

} // namespace voxsheet::import
