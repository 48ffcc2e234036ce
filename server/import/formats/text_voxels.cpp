#include "import/formats/text_voxels.h"

#include "base/errors.h"
#include "import/formats/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace voxsheet::import {

namespace {

/// Characters one at a time out of a stream.
class Letters {
public:
    explicit Letters(std::unique_ptr<ByteStream> stream) : stream_(std::move(stream)), block_(64 * 1024) {}

    std::optional<char> next() {
        if (at_ == filled_) {
            filled_ = stream_->read(block_);
            at_ = 0;
            if (filled_ == 0) return std::nullopt;
        }
        return static_cast<char>(block_[at_++]);
    }

private:
    std::unique_ptr<ByteStream> stream_;
    std::vector<std::byte> block_;
    std::size_t at_ = 0;
    std::size_t filled_ = 0;
};

bool isSeparator(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r' || letter == ',' ||
           letter == '\v' || letter == '\f';
}

template <typename T>
bool parseInto(std::string_view word, std::byte* out) {
    T value{};
    if constexpr (std::is_floating_point_v<T>) {
        const auto number = parseNumber(word);
        if (!number) return false;
        if (std::isfinite(*number) && std::abs(*number) > std::numeric_limits<T>::max()) return false;
        value = static_cast<T>(*number);
    } else {
        if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (code != std::errc{} || end != word.data() + word.size()) return false;
    }
    std::memcpy(out, &value, sizeof value);
    return true;
}

class AsciiVoxels final : public ByteStream {
public:
    AsciiVoxels(std::unique_ptr<ByteStream> text, ScalarType type, std::string name)
        : letters_(std::move(text)), type_(type), bytes_(scalarBytes(type)), name_(std::move(name)) {}

    std::size_t read(std::span<std::byte> out) override {
        std::size_t done = 0;
        while (done < out.size()) {
            if (at_ == bytes_ || !started_) {
                if (!decodeNext()) break;
                started_ = true;
                at_ = 0;
            }
            const auto count = std::min(bytes_ - at_, out.size() - done);
            std::memcpy(out.data() + done, value_.data() + at_, count);
            at_ += count;
            done += count;
        }
        return done;
    }

private:
    bool decodeNext() {
        std::array<char, 64> word{};
        std::size_t length = 0;
        auto letter = letters_.next();
        while (letter && isSeparator(*letter))
            letter = letters_.next();
        if (!letter) return false;
        for (; letter && !isSeparator(*letter); letter = letters_.next()) {
            if (length == word.size()) throwWord({word.data(), length});
            word[length++] = *letter;
        }
        const std::string_view text(word.data(), length);
        const bool fits = visitScalar(type_, [&]<typename T>() { return parseInto<T>(text, value_.data()); });
        if (!fits) throwWord(text);
        return true;
    }

    [[noreturn]] void throwWord(std::string_view word) const {
        throw InvalidInput(name_, "its text holds '" + printable(word) + "' where a number of type " +
                                      scalarName(type_) + " should be");
    }

    Letters letters_;
    ScalarType type_;
    std::size_t bytes_;
    std::string name_;
    std::array<std::byte, 8> value_{};
    std::size_t at_ = 0;
    bool started_ = false;
};

class HexVoxels final : public ByteStream {
public:
    HexVoxels(std::unique_ptr<ByteStream> text, std::string name)
        : letters_(std::move(text)), name_(std::move(name)) {}

    std::size_t read(std::span<std::byte> out) override {
        for (std::size_t done = 0; done < out.size(); ++done) {
            const auto high = nextDigit();
            if (!high) return done;
            const auto low = nextDigit();
            if (!low) throw InvalidInput(name_, "its hexadecimal data end in the middle of a byte");
            out[done] = static_cast<std::byte>(*high * 16U + *low);
        }
        return out.size();
    }

private:
    std::optional<unsigned> nextDigit() {
        auto letter = letters_.next();
        while (letter && isSeparator(*letter))
            letter = letters_.next();
        if (!letter) return std::nullopt;
        unsigned digit = 0;
        const auto [end, code] = std::from_chars(&*letter, &*letter + 1, digit, 16);
        if (code != std::errc{} || end != &*letter + 1)
            throw InvalidInput(name_, "its hexadecimal data hold '" + printable({&*letter, 1}) + "'");
        return digit;
    }

    Letters letters_;
    std::string name_;
};

} // namespace

std::unique_ptr<ByteStream> asciiVoxels(std::unique_ptr<ByteStream> text, ScalarType type, std::string name) {
    return std::make_unique<AsciiVoxels>(std::move(text), type, std::move(name));
}

std::unique_ptr<ByteStream> hexVoxels(std::unique_ptr<ByteStream> text, std::string name) {
    return std::make_unique<HexVoxels>(std::move(text), std::move(name));
}

} // namespace voxsheet::import
