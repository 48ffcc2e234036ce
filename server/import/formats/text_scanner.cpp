#include "import/formats/text_scanner.h"

#include "base/errors.h"
#include "import/formats/number_batch.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace voxsheet::import {

namespace {

constexpr std::size_t kBlockBytes = 256 * 1024;
constexpr std::size_t kLongestBytes = 64 * 1024;

constexpr bool isBlank(char letter) { return isTextBlank(letter); }

} // namespace

TextScanner::TextScanner(std::unique_ptr<ByteStream> stream, std::string name)
    : stream_(std::move(stream)), name_(std::move(name)), block_(kBlockBytes) {}

/// Moves the unread part to the front and fills up the block. False when nothing came.
bool TextScanner::fetch() {
    std::memmove(block_.data(), block_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    const auto got = stream_->read(std::as_writable_bytes(std::span(block_).subspan(end_)));
    end_ += got;
    fetched_ += got;
    return got > 0;
}

std::optional<std::string_view> TextScanner::line() {
    auto length = unread().find('\n');
    while (length == std::string_view::npos) {
        if (end_ - begin_ > kLongestBytes)
            throw InvalidInput(name_, "it has a line longer than 64 KiB: it is no text file");
        if (!fetch()) break;
        length = unread().find('\n');
    }
    if (end_ == begin_) return std::nullopt;
    auto text = unread().substr(0, length);
    begin_ += length == std::string_view::npos ? text.size() : length + 1;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

std::string_view TextScanner::word() {
    for (bool more = true;;) {
        while (begin_ < end_ && isBlank(block_[begin_]))
            ++begin_;
        std::size_t last = begin_;
        while (last < end_ && !isBlank(block_[last]))
            ++last;
        if (last < end_ || !more) {
            const std::string_view text(block_.data() + begin_, last - begin_);
            begin_ = last;
            return text;
        }
        if (last - begin_ > kLongestBytes)
            throw InvalidInput(name_, "it has a word longer than 64 KiB: it is no text file");
        more = fetch();
    }
}

std::uint64_t TextScanner::skipWords(std::uint64_t count, std::uint64_t mostBytes) {
    if (count == 0) return 0;
    const auto start = position();
    std::uint64_t found = 0;
    bool inWord = false;
    for (;;) {
        // Where even a block of one-letter words would not do, their ends are counted without a branch.
        if (const auto length = end_ - begin_; length > 0 && count - found > length / 2 + 1) {
            bool before = inWord;
            for (; begin_ < end_; ++begin_) {
                const bool letter = !isBlank(block_[begin_]);
                found += static_cast<std::uint64_t>(before && !letter);
                before = letter;
            }
            inWord = before;
        }
        for (; begin_ < end_; ++begin_) {
            const bool blank = isBlank(block_[begin_]);
            if (inWord && blank) {
                inWord = false;
                if (++found == count) return found;
            } else if (!blank) {
                inWord = true;
            }
        }
        if (position() - start > mostBytes) throw InvalidInput(name_, "it holds far more blanks than values");
        if (!fetch()) return found + (inWord ? 1 : 0);
    }
}

std::string_view TextScanner::peek(std::size_t bytes) {
    // Room for the word that goes on beyond them.
    if (block_.size() < bytes + kLongestBytes) block_.resize(bytes + kLongestBytes);
    bool more = true;
    while (more && end_ - begin_ < bytes)
        more = fetch();
    auto length = std::min(bytes, end_ - begin_);
    while (more && length > 0 && !isBlank(block_[begin_ + length - 1])) {
        if (begin_ + length == end_) {
            if (length >= bytes + kLongestBytes)
                throw InvalidInput(name_, "it has a word longer than 64 KiB: it is no text file");
            more = fetch();
            if (!more) break;
        }
        ++length;
    }
    return {block_.data() + begin_, length};
}

void TextScanner::skipBytes(std::uint64_t count) {
    const auto buffered = std::min<std::uint64_t>(count, end_ - begin_);
    begin_ += static_cast<std::size_t>(buffered);
    if (count > buffered) fetched_ += stream_->skip(count - buffered);
}

} // namespace voxsheet::import
