#include "sheet/colour.h"

#include "sheet/utf8.h"

namespace voxsheet::sheet {

namespace {

std::optional<unsigned> hexDigit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10U;
    return std::nullopt;
}

} // namespace

std::optional<Colour> parseColour(std::string_view text) {
    std::string digits = lowerAscii(text);
    if (digits == "transparent") return Colour{{0, 0, 0, 0}};
    if (!digits.empty() && digits.front() == '#') digits.erase(0, 1);
    if (digits.size() == 3) digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    if (digits.size() != 6 && digits.size() != 8) return std::nullopt;
    Colour colour;
    for (std::size_t i = 0; i < digits.size() / 2; ++i) {
        const auto high = hexDigit(digits[2 * i]);
        const auto low = hexDigit(digits[2 * i + 1]);
        if (!high || !low) return std::nullopt;
        colour.rgba[i] = static_cast<std::uint8_t>(*high * 16 + *low);
    }
    return colour;
}

std::string colourName(const Colour& colour) {
    if (colour == Colour{{0, 0, 0, 0}}) return "transparent";
    constexpr const char* hex = "0123456789abcdef";
    std::string name = "#";
    for (std::size_t i = 0; i < (colour.rgba[3] == 255 ? 3U : 4U); ++i) {
        name += hex[colour.rgba[i] / 16];
        name += hex[colour.rgba[i] % 16];
    }
    return name;
}

} // namespace voxsheet::sheet
