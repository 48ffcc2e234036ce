// Text from outside: is it UTF-8, and how to show it in a message.
#pragma once

#include <string>
#include <string_view>

namespace voxsheet::sheet {

/// Well-formed UTF-8 (Unicode 15, table 3-7): no overlong forms, surrogates or code points beyond U+10FFFF.
[[nodiscard]] bool isValidUtf8(std::string_view text);
/// Every ill-formed byte replaced by U+FFFD.
[[nodiscard]] std::string replaceInvalidUtf8(std::string_view text);
/// A byte below 0x20, or 0x7F.
[[nodiscard]] bool hasControlCharacter(std::string_view text);
/// In quotes, valid UTF-8, control characters replaced, cut after 60 bytes: safe in a log line and in JSON.
[[nodiscard]] std::string inQuotes(std::string_view text);
/// ASCII letters in lower case.
[[nodiscard]] std::string lowerAscii(std::string_view text);

} // namespace voxsheet::sheet
