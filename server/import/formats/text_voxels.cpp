#include "import/formats/text_voxels.h"

#include "base/errors.h"
#include "import/formats/number_batch.h"
#include "import/formats/number_text.h"

#include <algorithm>
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

constexpr std::string_view kSeparators = " \t\n\r,\v\f";

bool isSeparator(char letter) { return isTextBlank(letter) || letter == ','; }

/// Words that std::from_chars does not take as they are: signs, and numbers of a wider type.
template <typename T>
std::optional<T> parseWord(std::string_view word) {
    if constexpr (std::is_floating_point_v<T>) {
        const auto number = parseNumber(word);
        if (!number) return std::nullopt;
        if (std::isfinite(*number) && std::abs(*number) > std::numeric_limits<T>::max()) return std::nullopt;
        return static_cast<T>(*number);
    } else {
        if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
        T value{};
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (code != std::errc{} || end != word.data() + word.size()) return std::nullopt;
        return value;
    }
}

class AsciiVoxels final : public ByteStream {
public:
    AsciiVoxels(std::unique_ptr<ByteStream> text, ScalarType type, std::string name)
        : stream_(std::move(text)), type_(type), name_(std::move(name)) {}

    std::size_t read(std::span<std::byte> out) override {
        std::size_t done = 0;
        while (done < out.size()) {
            if (at_ == ready_.size() && !fetch((out.size() - done) / scalarBytes(type_) + 1)) break;
            const auto count = std::min(ready_.size() - at_, out.size() - done);
            std::memcpy(out.data() + done, ready_.data() + at_, count);
            at_ += count;
            done += count;
        }
        return done;
    }

private:
    /// Parses the next words, not many more than are wanted; false at the end of the text. What is wrong with
    /// a word is said when it is its turn: it may come after the voxels.
    bool fetch(std::size_t wanted) {
        ready_.clear();
        at_ = 0;
        while (ready_.empty()) {
            if (badWord_) throwWord(*badWord_);
            const auto words = nextWords(wanted);
            if (words == 0) return false;
            visitScalar(type_, [&]<typename T>() { parse<T>({text_.data(), words}); });
            text_.erase(0, words);
        }
        return true;
    }

    /// Length of the whole words at the beginning of text_, which is filled up; 0 at the end of the stream.
    std::size_t nextWords(std::size_t wanted) {
        constexpr std::size_t usualLetters = 16;
        constexpr std::size_t fewest = 4096;
        constexpr std::size_t longestWord = 64 * 1024;
        const auto target = std::clamp(wanted * usualLetters, fewest, kNumberBatchBytes);
        for (;;) {
            const auto kept = text_.size();
            if (kept < target || !hasWholeWord()) {
                text_.resize(kept + target);
                const auto got = stream_->read(std::as_writable_bytes(std::span(text_).subspan(kept)));
                text_.resize(kept + got);
                if (got == 0) return text_.size();
            }
            const auto last = text_.find_last_of(kSeparators);
            if (last != std::string::npos) return last + 1;
            if (text_.size() > longestWord) throwWord(text_);
        }
    }

    [[nodiscard]] bool hasWholeWord() const { return text_.find_last_of(kSeparators) != std::string::npos; }

    template <typename T>
    void parse(std::string_view words) {
        for (const auto& piece : parsePieces<T>(words, true, parseWord<T>)) {
            const auto bytes = std::as_bytes(std::span(piece.values));
            ready_.insert(ready_.end(), bytes.begin(), bytes.end());
            if (!piece.badWord) continue;
            badWord_ = std::string(*piece.badWord);
            return;
        }
    }

    [[noreturn]] void throwWord(std::string_view word) const {
        throw InvalidInput(name_, "its text holds '" + printable(word) + "' where a number of type " +
                                      scalarName(type_) + " should be");
    }

    std::unique_ptr<ByteStream> stream_;
    ScalarType type_;
    std::string name_;
    std::string text_; ///< read, not yet parsed
    std::vector<std::byte> ready_;
    std::size_t at_ = 0;
    std::optional<std::string> badWord_; ///< after what is ready
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
