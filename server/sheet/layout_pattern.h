// `--layout 'sub-{row}_{col}.nii.gz'`: places files by their names.
#pragma once

#include "sheet/address.h"
#include "sheet/layout.h"

#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::sheet {

struct PatternPlacement {
    std::vector<Address> places;           ///< one per path, in order, all different
    std::vector<std::string> columnTitles; ///< what {col} stood for, in natural order
    std::vector<std::string> rowTitles;    ///< what {row} stood for, in natural order
    Layout layout;
};

/// The pattern is matched against as many last path components as it has itself. `{row}` and `{col}` stand
/// for one or more characters other than '/', as few as possible; `*` for any number of them. Each of {row}
/// and {col} occurs at most once, and at least one of them occurs; one that is absent means a single row or
/// column. Throws InvalidInput if the pattern is none, a path does not match it, or two paths would share a
/// cell; LimitExceeded if the sheet would be too large.
[[nodiscard]] PatternPlacement placeByPattern(std::string_view pattern,
                                              const std::vector<std::string>& paths);

} // namespace voxsheet::sheet
