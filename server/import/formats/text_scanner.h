// Lines and words of a long text file, decompressed on the way, without holding more than a block of it.
#pragma once

#include "import/formats/byte_stream.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

class TextScanner {
public:
    /// `name` is the subject of errors.
    TextScanner(std::unique_ptr<ByteStream> stream, std::string name);

    /// The next line without its end; valid until the next call. nullopt at the end of the file. Throws
    /// InvalidInput if a line is longer than 64 KiB.
    [[nodiscard]] std::optional<std::string_view> line();
    /// The next word between blanks and line ends; valid until the next call. Empty at the end of the file.
    /// Throws InvalidInput if a word is longer than 64 KiB.
    [[nodiscard]] std::string_view word();
    /// Passes over up to `count` words; returns how many there were. Throws InvalidInput after `mostBytes` of
    /// text: a small compressed file can hold blanks without end.
    [[nodiscard]] std::uint64_t skipWords(std::uint64_t count, std::uint64_t mostBytes);

    /// The next bytes, at least `bytes` where the file has them and then up to the end of a word; they stay
    /// unread. Valid until the next call. Throws InvalidInput if a word is longer than 64 KiB.
    [[nodiscard]] std::string_view peek(std::size_t bytes);

    /// Offset of the next unread byte in the decompressed text.
    [[nodiscard]] std::uint64_t position() const { return fetched_ - (end_ - begin_); }
    /// Passes over `count` bytes, without reading them where the file is not compressed.
    void skipBytes(std::uint64_t count);
    /// The file ends right here, without a line end.
    [[nodiscard]] bool atEnd() { return begin_ == end_ && !fetch(); }

private:
    bool fetch();
    [[nodiscard]] std::string_view unread() const { return {block_.data() + begin_, end_ - begin_}; }

    std::unique_ptr<ByteStream> stream_;
    std::string name_;
    std::vector<char> block_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::uint64_t fetched_ = 0; ///< bytes taken from the stream
};

} // namespace voxsheet::import
