// Names for datasets: the shortest tail of the path that tells them apart, in natural order (`run2` before
// `run10`).
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::sheet {

/// Digits compare as numbers of any length, letters whatever their case; ties are broken so that the order is
/// total.
[[nodiscard]] bool naturalLess(std::string_view a, std::string_view b);
void sortNaturally(std::vector<std::string>& paths);

/// One name per path, in order, all different from each other and from `taken`: the fewest last components
/// that no other path ends in (`run1/CHGCAR`, `run2/CHGCAR`); what is still equal gets " (2)", " (3)", ….
/// What a name may not hold (validateDatasetName) becomes '_'; bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::vector<std::string> distinguishingNames(const std::vector<std::string>& paths,
                                                           const std::set<std::string>& taken = {});

} // namespace voxsheet::sheet
