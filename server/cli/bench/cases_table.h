// What a bench found, for people: a line per case, columns under each other.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace voxsheet::cli {

/// A heading and a line per object of the array: texts first and to the left, then numbers, to the right,
/// with two decimals where some of a column have any; yes and no; other values as JSON. A case without a
/// column's key has "-" there. Nothing without cases.
[[nodiscard]] std::string casesTable(const nlohmann::json& cases);

} // namespace voxsheet::cli
