// What the tests of the workbook share.
#pragma once

#include "base/errors.h"
#include "sheet/commands.h"
#include "sheet/formula/values.h"
#include "sheet/history.h"
#include "sheet/style_keys.h"
#include "sheet/workbook.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace voxsheet::sheet {

inline const KeyTable& testKeys() {
    static const KeyTable table = makeKeyTable({"grey", "viridis", "cool-warm"});
    return table;
}

/// A workbook of `columns` x `rows` cells that hold the datasets d1, d2, … in reading order.
inline Workbook filledWorkbook(int columns, int rows) {
    Workbook workbook;
    Sheet& sheet = workbook.sheets.front();
    sheet.columns = columns;
    sheet.rows = rows;
    for (int i = 0; i < columns * rows; ++i) {
        const std::string name = "d" + std::to_string(i + 1);
        workbook.datasets[name] = {
            .files = {"/data/" + name + ".nrrd"}, .bytes = 10, .checksum = "", .options = "{}"};
        sheet.cells[{i % columns, i / columns}].source = name;
    }
    return workbook;
}

inline Grid testGrid(int n) {
    Grid grid;
    grid.dims = glm::ivec3(n);
    return grid;
}

inline DatasetLookup allReady(int n) {
    return [n](const std::string&) -> DatasetState { return DatasetReady{testGrid(n)}; };
}

/// Runs the statement and gives the error that it throws; fails the test if it throws none of that kind.
template <typename ErrorType, typename Statement>
Error caught(Statement statement) {
    try {
        statement();
    } catch (const ErrorType& error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return InternalError("nothing", "was thrown");
}

} // namespace voxsheet::sheet
