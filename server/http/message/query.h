// Percent-encoding and the query of a URL as typed values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxsheet::http {

/// Decodes %XX (and '+' as a space where `plusIsSpace`). Nothing if an escape is malformed, or if the result
/// holds a NUL.
[[nodiscard]] std::optional<std::string> percentDecoded(std::string_view text, bool plusIsSpace);
/// Encodes everything but RFC 3986's unreserved characters.
[[nodiscard]] std::string percentEncoded(std::string_view text);

/// KEY=VALUE pairs of a query; each key at most once. Typed members throw InvalidInput with the key as field.
class Query {
public:
    Query() = default;
    /// Throws InvalidInput for a malformed escape, a key that comes twice, or more than 200 keys.
    explicit Query(std::string_view encoded);

    [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
    [[nodiscard]] std::string requireText(std::string_view key) const;
    [[nodiscard]] std::optional<double> number(std::string_view key, double min, double max) const;
    [[nodiscard]] double requireNumber(std::string_view key, double min, double max) const;
    [[nodiscard]] std::optional<long long> integer(std::string_view key, long long min, long long max) const;
    [[nodiscard]] std::optional<bool> boolean(std::string_view key) const; ///< true|1, false|0
    [[nodiscard]] bool has(std::string_view key) const { return text(key).has_value(); }
    void remove(std::string_view key);
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& pairs() const { return pairs_; }

private:
    std::vector<std::pair<std::string, std::string>> pairs_;
};

} // namespace voxsheet::http
