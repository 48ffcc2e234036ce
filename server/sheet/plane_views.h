// Three planes beside a volume: axial, coronal and sagittal, in cells of their own.
#pragma once

#include "sheet/commands.h"

#include <string>
#include <vector>

namespace voxsheet::sheet {

/// Edits, one undo step together, that show each of the cells as three planes in the three cells to its
/// right, or below it where those are not free for every one of them (rows are inserted where neither are),
/// with the cell's own style otherwise. A cell that shows a plane itself becomes a volume again. Where they
/// have no crosshair yet, the sheet gets one in the middle, by which the planes are linked. Throws
/// InvalidInput (field cells) if a cell shows nothing or none is given, NotFound if one is outside the sheet,
/// LimitExceeded if the sheet cannot grow as far.
[[nodiscard]] std::vector<Command> planesBeside(const Workbook& workbook, const KeyTable& keys,
                                                const std::string& sheet, const std::vector<Address>& cells);

} // namespace voxsheet::sheet
