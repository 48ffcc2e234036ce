// "Did you mean": the name that was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::sheet {

/// Insertions, deletions, substitutions and swaps of neighbours between two words, whatever the case (the
/// "optimal string alignment" distance).
[[nodiscard]] int editDistance(std::string_view a, std::string_view b);

/// The nearest candidate if it is near enough to be meant (at most a third of its letters differ), or a
/// candidate whose last dotted part is the word; else empty.
[[nodiscard]] std::string nearestName(std::string_view word, const std::vector<std::string>& candidates);

} // namespace voxsheet::sheet
