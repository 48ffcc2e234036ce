// Style values that name volumes (clip.shape, isosurface.colorBy, layers, overlay.dataset) follow them when
// cells move and when sheets or datasets get another name, as formulas do.
#pragma once

#include "sheet/formula/references.h"
#include "sheet/workbook.h"

#include <functional>
#include <string_view>

namespace voxsheet::sheet {

/// Calls `visit` for every style of the sheet: its own, those of columns, rows and cells.
void forEachStyle(Sheet& sheet, const std::function<void(StyleMap&)>& visit);

/// Cells that are named become those that they are now; one that is gone becomes #REF!, as in a formula. What
/// does not name a cell stays as it was written.
void moveStyleReferences(StyleMap& style, const ReferenceMove& move);

/// Cells of sheet `from` (whatever the case) become cells of `to`; an empty `to`: #REF!.
void renameSheetInStyle(StyleMap& style, std::string_view from, std::string_view to);

void renameDatasetInStyle(StyleMap& style, std::string_view from, std::string_view to);

} // namespace voxsheet::sheet
