#include "engine/unit_text.h"

#include <array>
#include <cctype>

namespace voxsheet::engine {

std::string unitText(const std::string& unit) {
    static const std::array<const char*, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const auto digitAt = [&](std::size_t i) {
        return i < unit.size() && std::isdigit(static_cast<unsigned char>(unit[i])) != 0;
    };
    std::string text;
    for (std::size_t i = 0; i < unit.size(); ++i) {
        const bool negative = i + 1 < unit.size() && unit[i + 1] == '-';
        const std::size_t digit = i + (negative ? 2 : 1);
        if (unit[i] != '^' || !digitAt(digit) || digitAt(digit + 1)) {
            text += unit[i];
            continue;
        }
        if (negative) text += "⁻";
        text += raised.at(static_cast<std::size_t>(unit[digit] - '0'));
        i = digit;
    }
    return text;
}

} // namespace voxsheet::engine
