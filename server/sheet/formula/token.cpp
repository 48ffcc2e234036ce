#include "sheet/formula/token.h"

#include <charconv>
#include <cmath>

namespace voxsheet::sheet {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordStart(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }
bool isWord(char c) { return isWordStart(c) || isDigit(c) || c == '.'; }
bool isBlank(char c) { return c == ' ' || c == '\t'; }

class Tokenizer {
public:
    explicit Tokenizer(std::string_view text) : text_(text) {}

    std::vector<Token> run() {
        std::vector<Token> tokens;
        at_ = !text_.empty() && text_.front() == '=' ? 1 : 0;
        do {
            while (at_ < text_.size() && isBlank(text_[at_]))
                ++at_;
            tokens.push_back(next());
        } while (tokens.back().kind != TokenKind::End);
        return tokens;
    }

private:
    Token next() {
        if (at_ >= text_.size()) return take(TokenKind::End, 0);
        const char c = text_[at_];
        if (isDigit(c) || (c == '.' && at_ + 1 < text_.size() && isDigit(text_[at_ + 1]))) return number();
        if (isWordStart(c)) return word();
        if (c == '\'') return quotedSheet();
        constexpr std::string_view broken = "#REF!";
        if (text_.substr(at_, broken.size()) == broken)
            return take(TokenKind::BrokenReference, broken.size());
        return symbol(c);
    }

    Token take(TokenKind kind, std::size_t length) {
        Token token{kind, at_, at_ + length, std::string(text_.substr(at_, length)), 0.0};
        at_ += length;
        return token;
    }

    Token number() {
        double value = 0.0;
        const char* begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        const bool good = error == std::errc{} && std::isfinite(value);
        Token token =
            take(good ? TokenKind::Number : TokenKind::Unknown, static_cast<std::size_t>(end - begin));
        token.number = good ? value : 0.0;
        return token;
    }

    Token word() {
        std::size_t length = 1;
        while (at_ + length < text_.size() && isWord(text_[at_ + length]))
            ++length;
        return take(TokenKind::Word, length);
    }

    Token quotedSheet() {
        const std::size_t close = text_.find('\'', at_ + 1);
        if (close == std::string_view::npos) return take(TokenKind::Unknown, 1);
        Token token = take(TokenKind::QuotedSheet, close + 1 - at_);
        token.text = token.text.substr(1, token.text.size() - 2);
        return token;
    }

    Token symbol(char c) {
        switch (c) {
        case '+':
            return take(TokenKind::Plus, 1);
        case '-':
            return take(TokenKind::Minus, 1);
        case '*':
            return take(TokenKind::Star, 1);
        case '/':
            return take(TokenKind::Slash, 1);
        case '(':
            return take(TokenKind::Open, 1);
        case ')':
            return take(TokenKind::Close, 1);
        case ',':
            return take(TokenKind::Comma, 1);
        case ':':
            return take(TokenKind::Colon, 1);
        case '!':
            return take(TokenKind::Bang, 1);
        default:
            break;
        }
        // A character of several bytes is one token, so that messages can show it.
        std::size_t length = 1;
        while (at_ + length < text_.size() &&
               (static_cast<unsigned char>(text_[at_ + length]) & 0xC0U) == 0x80U)
            ++length;
        return take(TokenKind::Unknown, length);
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace

std::vector<Token> tokenizeFormula(std::string_view text) { return Tokenizer(text).run(); }

} // namespace voxsheet::sheet
