// Decodes a chunked body piece by piece (RFC 9112, section 7.1) within a byte budget.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace voxsheet::http {

class ChunkedDecoder {
public:
    /// Takes as much of `bytes` as belongs to the body and appends what it decodes to `out`; returns the
    /// number of bytes taken. Throws InvalidInput for anything malformed (a size of more than 15 hex digits,
    /// a missing line end, more than 8 KiB of extensions or trailers).
    std::size_t feed(std::string_view bytes, std::string& out);
    [[nodiscard]] bool done() const { return state_ == State::Done; }
    /// What the chunk sizes read so far announce: lets a caller refuse a body before it arrives.
    [[nodiscard]] std::uint64_t announcedBytes() const { return announced_; }

private:
    enum class State {
        Size,
        Extension,
        SizeLineFeed,
        Data,
        DataReturn,
        DataLineFeed,
        Trailer,
        TrailerLineFeed,
        Done
    };
    void sizeCharacter(char c);
    void endSize();
    void trailerCharacter(char c);

    State state_ = State::Size;
    int digits_ = 0;
    std::uint64_t left_ = 0;
    std::uint64_t announced_ = 0;
    std::size_t overhead_ = 0;
    bool trailerLineEmpty_ = true;
};

} // namespace voxsheet::http
