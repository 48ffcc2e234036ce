// Errors of cells: values, shown in the cell as in any spreadsheet.
#pragma once

#include <string>

namespace voxsheet::sheet {

enum class CellErrorCode { Ref, Name, Cycle, Grid, Type, Mem, Import };

/// "#REF!", "#NAME?", "#CYCLE!", "#GRID!", "#TYPE!", "#MEM!", "#IMPORT!".
[[nodiscard]] const char* cellErrorCodeName(CellErrorCode code);

struct CellError {
    CellErrorCode code = CellErrorCode::Ref;
    std::string sentence; ///< what is wrong and what to do
    bool operator==(const CellError&) const = default;
};

} // namespace voxsheet::sheet
