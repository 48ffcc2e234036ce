// Numbers as text, exactly and whatever the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::sheet {

/// The shortest text that reads back to the same double.
[[nodiscard]] std::string numberText(double value);
/// A whole decimal number and nothing else; finite.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

} // namespace voxsheet::sheet
