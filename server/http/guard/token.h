// The secret that opens the server.
#pragma once

#include <string>
#include <string_view>

namespace voxsheet::http {

/// 128 random bits as 32 hex digits, from the kernel.
[[nodiscard]] std::string randomToken();

/// 8 to 256 characters that need no escape in a URL or a cookie: letters, digits and `-._~`. Throws
/// InvalidInput.
void validateToken(std::string_view token);

/// Takes the same time whatever differs (the lengths aside).
[[nodiscard]] bool equalInConstantTime(std::string_view a, std::string_view b);

/// A cookie name of its own for each token: cookies ignore ports, so two servers reached through tunnels on
/// one machine would otherwise overwrite each other's.
[[nodiscard]] std::string cookieNameFor(std::string_view token);

} // namespace voxsheet::http
