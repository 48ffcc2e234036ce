// Just enough JSON to print results where no JSON library is installed.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace voxsheet::bench {

/// With quotes and escapes.
[[nodiscard]] std::string jsonString(const std::string& text);
/// Six significant digits; null for an absent or not finite number.
[[nodiscard]] std::string jsonNumber(std::optional<double> number);
/// Members whose values are JSON already.
[[nodiscard]] std::string jsonObject(const std::vector<std::pair<std::string, std::string>>& members);
[[nodiscard]] std::string jsonArray(const std::vector<std::string>& values);

} // namespace voxsheet::bench
