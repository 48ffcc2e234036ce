// Numbered data files, as NRRD and MetaImage headers name them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

inline constexpr std::size_t kMostDataFiles = 100'000;

/// "slice.%03d 1 93 1" and, with an ignored last number, "slice.%03d 1 93 1 2": the names with first, last
/// (inclusive) and step filled in. One integer conversion and nothing else of printf; nullopt for anything
/// else, and for too many names.
[[nodiscard]] std::optional<std::vector<std::string>> expandFilePattern(std::string_view value);

} // namespace voxsheet::import
