#include "sheet/formula/cell_error.h"

namespace voxsheet::sheet {

const char* cellErrorCodeName(CellErrorCode code) {
    switch (code) {
    case CellErrorCode::Ref:
        return "#REF!";
    case CellErrorCode::Name:
        return "#NAME?";
    case CellErrorCode::Cycle:
        return "#CYCLE!";
    case CellErrorCode::Grid:
        return "#GRID!";
    case CellErrorCode::Type:
        return "#TYPE!";
    case CellErrorCode::Mem:
        return "#MEM!";
    case CellErrorCode::Import:
        break;
    }
    return "#IMPORT!";
}

} // namespace voxsheet::sheet
