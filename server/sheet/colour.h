// Colours as style values: display sRGB with opacity, 8 bits each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::sheet {

struct Colour {
    std::array<std::uint8_t, 4> rgba{0, 0, 0, 255}; ///< not premultiplied; alpha 0 = transparent

    bool operator==(const Colour&) const = default;
    [[nodiscard]] double red() const { return rgba[0] / 255.0; }
    [[nodiscard]] double green() const { return rgba[1] / 255.0; }
    [[nodiscard]] double blue() const { return rgba[2] / 255.0; }
    [[nodiscard]] double alpha() const { return rgba[3] / 255.0; }
};

/// `#rgb`, `#rrggbb`, `#rrggbbaa` (the # may be left out: it is awkward in a URL) or `transparent`; nothing
/// else.
[[nodiscard]] std::optional<Colour> parseColour(std::string_view text);
/// `#rrggbb`, `#rrggbbaa` or `transparent`.
[[nodiscard]] std::string colourName(const Colour& colour);

} // namespace voxsheet::sheet
