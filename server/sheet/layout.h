// How many columns and rows a sheet of N cells gets.
#pragma once

#include "sheet/workbook.h"

#include <cstddef>
#include <vector>

namespace voxsheet::sheet {

struct Layout {
    int columns = 1;
    int rows = 1;
    bool operator==(const Layout&) const = default;
};

/// Near-square with columns >= rows: columns = ceil(sqrt(n)), rows = ceil(n / columns). 0 counts as 1.
/// Throws LimitExceeded beyond kMaxCells.
[[nodiscard]] Layout chooseLayout(std::size_t cells);
/// rows = ceil(n / columns). Throws InvalidInput if columns is not in [1, kMaxColumns], LimitExceeded beyond
/// the limits.
[[nodiscard]] Layout layoutWithColumns(std::size_t cells, int columns);

/// The first `count` cells without a source, in reading order, of a sheet that grew as far as needed.
struct FreeCells {
    std::vector<Address> cells;
    Layout grown;
};
/// No cell moves. With Sheet::autoLayout, a sheet without any source is laid out by chooseLayout and others
/// grow by a column while columns <= rows, else by a row; without it, by rows only. Throws LimitExceeded.
[[nodiscard]] FreeCells freeCells(const Sheet& sheet, std::size_t count);

} // namespace voxsheet::sheet
