#include "sheet/layout.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::sheet {

namespace {

void requireRoom(std::size_t columns, std::size_t rows) {
    if (columns > kMaxColumns || rows > kMaxRows || columns * rows > kMaxCells)
        throw LimitExceeded("sheet of " + std::to_string(columns) + " x " + std::to_string(rows) + " cells",
                            "is larger than a sheet can be (" + std::to_string(kMaxColumns) + " columns, " +
                                std::to_string(kMaxRows) + " rows, " + std::to_string(kMaxCells) + " cells)",
                            "use more columns, or several sheets");
}

} // namespace

Layout chooseLayout(std::size_t cells) {
    const std::size_t n = std::max<std::size_t>(cells, 1);
    std::size_t columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    while (columns * columns < n)
        ++columns;
    const std::size_t rows = (n + columns - 1) / columns;
    requireRoom(columns, rows);
    return {static_cast<int>(columns), static_cast<int>(rows)};
}

Layout layoutWithColumns(std::size_t cells, int columns) {
    if (columns < 1 || columns > kMaxColumns)
        throw InvalidInput("columns",
                           std::to_string(columns) + " is not from 1 to " + std::to_string(kMaxColumns),
                           "give such a number")
            .withField("columns");
    const auto across = static_cast<std::size_t>(columns);
    const std::size_t rows = std::max<std::size_t>((cells + across - 1) / across, 1);
    requireRoom(across, rows);
    return {columns, static_cast<int>(rows)};
}

FreeCells freeCells(const Sheet& sheet, std::size_t count) {
    const auto used =
        static_cast<std::size_t>(std::count_if(sheet.cells.begin(), sheet.cells.end(), [](const auto& entry) {
            return !entry.second.source.empty();
        }));
    FreeCells free;
    free.grown = sheet.autoLayout && used == 0 ? chooseLayout(count) : Layout{sheet.columns, sheet.rows};
    // An empty cell with a style or a title outside the new size would be lost.
    for (const auto& [address, cell] : sheet.cells) {
        free.grown.columns = std::max(free.grown.columns, address.column + 1);
        free.grown.rows = std::max(free.grown.rows, address.row + 1);
    }
    const auto area = [&] {
        return static_cast<std::size_t>(free.grown.columns) * static_cast<std::size_t>(free.grown.rows);
    };
    while (area() < used + count) {
        const bool wider = sheet.autoLayout && free.grown.columns <= free.grown.rows;
        (wider ? free.grown.columns : free.grown.rows) += 1;
        requireRoom(static_cast<std::size_t>(free.grown.columns), static_cast<std::size_t>(free.grown.rows));
    }
    for (int row = 0; row < free.grown.rows; ++row) {
        for (int column = 0; column < free.grown.columns && free.cells.size() < count; ++column) {
            const Cell* cell = sheet.find({column, row});
            if (!cell || cell->source.empty()) free.cells.push_back({column, row});
        }
    }
    return free;
}

} // namespace voxsheet::sheet
