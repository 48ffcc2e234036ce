#include "sheet/utf8.h"

#include <algorithm>
#include <cstddef>

namespace voxsheet::sheet {

namespace {

bool isContinuation(unsigned char byte, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte >= low && byte <= high;
}

/// Bytes of the well-formed sequence at the start of a non-empty text; 0 if there is none.
std::size_t sequenceLength(std::string_view text) {
    const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const unsigned lead = at(0);
    if (lead < 0x80) return 1;
    const auto follows = [&](std::size_t i) { return isContinuation(static_cast<unsigned char>(at(i))); };
    if (lead >= 0xC2 && lead <= 0xDF) return follows(1) ? 2 : 0;
    // The second byte's range excludes overlong forms (E0, F0), surrogates (ED) and code points > U+10FFFF
    // (F4).
    const auto second = static_cast<unsigned char>(at(1));
    if (lead >= 0xE0 && lead <= 0xEF) {
        const bool inRange = isContinuation(second, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF);
        return inRange && follows(2) ? 3 : 0;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        const bool inRange = isContinuation(second, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF);
        return inRange && follows(2) && follows(3) ? 4 : 0;
    }
    return 0;
}

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

} // namespace

bool isValidUtf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string replaceInvalidUtf8(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        if (length == 0)
            out += "\xEF\xBF\xBD";
        else
            out += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

bool hasControlCharacter(std::string_view text) { return std::any_of(text.begin(), text.end(), isControl); }

std::string inQuotes(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string shown;
    while (!text.empty() && shown.size() < longest) {
        const std::size_t length = sequenceLength(text);
        if (length == 0 || isControl(text.front()))
            shown += "\xEF\xBF\xBD";
        else
            shown += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return "\"" + shown + (text.empty() ? "\"" : "…\"");
}

std::string lowerAscii(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

} // namespace voxsheet::sheet
