#include "http/message/query.h"

#include "base/errors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace voxsheet::http {

namespace {

constexpr std::size_t kMaxKeys = 200;

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string decodedPart(std::string_view text) {
    auto out = percentDecoded(text, true);
    if (!out) throw InvalidInput("query", "a percent escape is malformed", "write %25 for a percent sign");
    return *std::move(out);
}

std::string asText(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

[[noreturn]] void outside(std::string_view key, const std::string& value, const std::string& range) {
    throw InvalidInput("query key '" + std::string(key) + "'", "'" + value + "' is not " + range)
        .withField(std::string(key));
}

} // namespace

std::optional<std::string> percentDecoded(std::string_view text, bool plusIsSpace) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            if (i + 2 >= text.size()) return std::nullopt;
            const int high = hexDigit(text[i + 1]);
            const int low = hexDigit(text[i + 2]);
            if (high < 0 || low < 0) return std::nullopt;
            c = static_cast<char>(high * 16 + low);
            i += 2;
        } else if (c == '+' && plusIsSpace) {
            c = ' ';
        }
        if (c == '\0') return std::nullopt;
        out.push_back(c);
    }
    return out;
}

std::string percentEncoded(std::string_view text) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    constexpr std::string_view marks = "-._~";
    std::string out;
    for (const char c : text) {
        if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
            marks.find(c) != std::string_view::npos) {
            out.push_back(c);
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        out.push_back('%');
        out.push_back(digits[byte >> 4U]);
        out.push_back(digits[byte & 15U]);
    }
    return out;
}

Query::Query(std::string_view encoded) {
    while (!encoded.empty()) {
        const auto end = encoded.find('&');
        const auto part = encoded.substr(0, end);
        encoded.remove_prefix(end == std::string_view::npos ? encoded.size() : end + 1);
        if (part.empty()) continue;
        const auto equals = part.find('=');
        auto key = decodedPart(part.substr(0, equals));
        auto value = equals == std::string_view::npos ? std::string{} : decodedPart(part.substr(equals + 1));
        if (has(key)) throw InvalidInput("query key '" + key + "'", "it comes twice").withField(key);
        if (pairs_.size() >= kMaxKeys) throw InvalidInput("query", "it has more than 200 keys");
        pairs_.emplace_back(std::move(key), std::move(value));
    }
}

std::optional<std::string> Query::text(std::string_view key) const {
    for (const auto& [name, value] : pairs_)
        if (name == key) return value;
    return std::nullopt;
}

std::string Query::requireText(std::string_view key) const {
    auto value = text(key);
    if (!value || value->empty())
        throw InvalidInput("query", "the key '" + std::string(key) + "' is missing")
            .withField(std::string(key));
    return *std::move(value);
}

std::optional<double> Query::number(std::string_view key, double min, double max) const {
    const auto value = text(key);
    if (!value) return std::nullopt;
    double number = 0.0;
    const auto* end = value->data() + value->size();
    const auto result = std::from_chars(value->data(), end, number);
    if (value->empty() || result.ec != std::errc{} || result.ptr != end || !std::isfinite(number) ||
        number < min || number > max)
        outside(key, *value, "a number from " + asText(min) + " to " + asText(max));
    return number;
}

double Query::requireNumber(std::string_view key, double min, double max) const {
    static_cast<void>(requireText(key));
    return *number(key, min, max);
}

std::optional<long long> Query::integer(std::string_view key, long long min, long long max) const {
    const auto value = text(key);
    if (!value) return std::nullopt;
    long long number = 0;
    const auto* end = value->data() + value->size();
    const auto result = std::from_chars(value->data(), end, number);
    if (value->empty() || result.ec != std::errc{} || result.ptr != end || number < min || number > max)
        outside(key, *value, "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
    return number;
}

std::optional<bool> Query::boolean(std::string_view key) const {
    const auto value = text(key);
    if (!value) return std::nullopt;
    if (*value == "true" || *value == "1") return true;
    if (*value == "false" || *value == "0") return false;
    outside(key, *value, "true or false");
}

void Query::remove(std::string_view key) {
    std::erase_if(pairs_, [&](const auto& pair) { return pair.first == key; });
}

} // namespace voxsheet::http
