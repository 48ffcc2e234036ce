// What every cell of a workbook holds: a dataset, a plan to compute, or an error with a sentence.
#pragma once

#include "sheet/formula/cell_error.h"
#include "sheet/formula/plan.h"
#include "sheet/style.h"
#include "sheet/workbook.h"
#include "volume/grid.h"

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace voxsheet::sheet {

/// What the engine knows of a dataset.
struct DatasetReady {
    Grid grid;
};
struct DatasetPending {}; ///< still being imported
struct DatasetFailed {
    std::string sentence; ///< why the import failed
};
using DatasetState = std::variant<DatasetPending, DatasetReady, DatasetFailed>;
/// Asked once per dataset that a cell uses; only names of Workbook::datasets.
using DatasetLookup = std::function<DatasetState(const std::string& name)>;

struct CellPosition {
    std::size_t sheet = 0; ///< index into Workbook::sheets
    Address cell;
    auto operator<=>(const CellPosition&) const = default;
};

struct EmptyValue {};
struct PendingValue {
    std::string dataset; ///< the one that is waited for
};
struct DatasetValue {
    std::string dataset;
    Grid grid;
};
struct FormulaValue {
    FormulaPlan plan;
    Grid grid;                      ///< of the first input
    std::vector<std::string> notes; ///< what a user should know, one sentence each
};
using CellValue = std::variant<EmptyValue, PendingValue, DatasetValue, FormulaValue, CellError>;

struct WorkbookValues {
    std::map<CellPosition, CellValue> cells; ///< of every cell with a source
    std::vector<CellPosition> order;         ///< formula cells, each after the cells that it reads
};

/// Rules. Formulas compute over cells of equal dims; others are #GRID!. Where dims agree but positions do
/// not, the first input's geometry holds and a note says so. A reference to a cell in error gives that cell's
/// code; to a cell of a cycle, #CYCLE!. A cell without content, outside its sheet or on no sheet is #REF!. A
/// formula without any cell is #TYPE!.
[[nodiscard]] WorkbookValues evaluateWorkbook(const KeyTable& keys, const Workbook& workbook,
                                              const DatasetLookup& lookup);

/// EmptyValue if the cell has no source.
[[nodiscard]] const CellValue& valueAt(const WorkbookValues& values, const CellPosition& position);

} // namespace voxsheet::sheet
