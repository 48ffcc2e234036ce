#include "http/message/chunked_decoder.h"

#include "base/errors.h"

#include <algorithm>

namespace voxsheet::http {

namespace {

constexpr std::size_t kMaxOverheadBytes = 8192; // of extensions and trailers, which nobody here needs

[[noreturn]] void malformed(const char* why) { throw InvalidInput("chunked body", why); }

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

void expect(char c, char wanted) {
    if (c != wanted) malformed("a line does not end where it should");
}

} // namespace

std::size_t ChunkedDecoder::feed(std::string_view bytes, std::string& out) {
    std::size_t taken = 0;
    while (taken < bytes.size() && state_ != State::Done) {
        if (state_ == State::Data) {
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size() - taken));
            out.append(bytes.substr(taken, count));
            taken += count;
            left_ -= count;
            if (left_ == 0) state_ = State::DataReturn;
            continue;
        }
        const char c = bytes[taken++];
        switch (state_) {
        case State::Size:
            sizeCharacter(c);
            break;
        case State::Extension:
            if (c == '\r')
                state_ = State::SizeLineFeed;
            else if (c == '\n' || ++overhead_ > kMaxOverheadBytes)
                malformed("a chunk extension is malformed");
            break;
        case State::SizeLineFeed:
            expect(c, '\n');
            endSize();
            break;
        case State::DataReturn:
            expect(c, '\r');
            state_ = State::DataLineFeed;
            break;
        case State::DataLineFeed:
            expect(c, '\n');
            state_ = State::Size;
            break;
        case State::Trailer:
            trailerCharacter(c);
            break;
        case State::TrailerLineFeed:
            expect(c, '\n');
            state_ = trailerLineEmpty_ ? State::Done : State::Trailer;
            trailerLineEmpty_ = true;
            break;
        case State::Data:
        case State::Done:
            break;
        }
    }
    return taken;
}

void ChunkedDecoder::sizeCharacter(char c) {
    const int digit = hexDigit(c);
    if (digit >= 0) {
        if (++digits_ > 15) malformed("a chunk size is too long");
        left_ = left_ * 16 + static_cast<std::uint64_t>(digit);
        return;
    }
    if (digits_ == 0) malformed("a chunk size is not a hexadecimal number");
    if (c == '\r')
        state_ = State::SizeLineFeed;
    else if (c == ';' || c == ' ' || c == '\t')
        state_ = State::Extension;
    else
        malformed("a chunk size is not a hexadecimal number");
}

void ChunkedDecoder::endSize() {
    digits_ = 0;
    announced_ += left_;
    state_ = left_ == 0 ? State::Trailer : State::Data;
}

void ChunkedDecoder::trailerCharacter(char c) {
    if (c == '\r') {
        state_ = State::TrailerLineFeed;
        return;
    }
    if (c == '\n' || ++overhead_ > kMaxOverheadBytes) malformed("a trailer is malformed");
    trailerLineEmpty_ = false;
}

} // namespace voxsheet::http
