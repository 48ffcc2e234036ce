// Numbers of bytes as people write and read them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace voxsheet {

/// "512M", "2G", "1.5GiB", "4096": K, M, G and T are powers of 1024. Empty text is 0. Throws InvalidInput,
/// with `field`, for anything else, and for what is not above 0.
[[nodiscard]] std::uint64_t parseBytes(const std::string& text, const std::string& field);

/// "256 MiB", "1.5 GiB".
[[nodiscard]] std::string byteText(std::uint64_t bytes);

/// A few coarsest levels of large volumes: less is of no use.
inline constexpr std::uint64_t kSmallestBudgetBytes = std::uint64_t{1} << 20;

/// As parseBytes; the error names the flag and its bounds: kSmallestBudgetBytes to `largest` (absent: the
/// device says). An empty text is 0: the default.
[[nodiscard]] std::uint64_t parseBudget(const std::string& text, const std::string& flag,
                                        std::optional<std::uint64_t> largest);

} // namespace voxsheet
