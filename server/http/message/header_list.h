// The header fields of a message, in order, as raw bytes: no decoding, no joining.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxsheet::http {

/// ASCII letters only, as field names and schemes are compared (RFC 9110, 5.1).
[[nodiscard]] bool equalIgnoringCase(std::string_view a, std::string_view b);
[[nodiscard]] std::string lowerCase(std::string_view text);
/// Without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

class HeaderList {
public:
    void add(std::string name, std::string value) { fields_.emplace_back(std::move(name), std::move(value)); }
    /// Replaces all fields of that name.
    void set(const std::string& name, std::string value);
    [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const; ///< the first one
    [[nodiscard]] std::size_t count(std::string_view name) const;
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& fields() const { return fields_; }

private:
    std::vector<std::pair<std::string, std::string>> fields_;
};

} // namespace voxsheet::http
