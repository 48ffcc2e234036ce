// What each command does to a copy of the workbook; internal to apply().
#pragma once

#include "sheet/commands.h"

#include <functional>
#include <optional>
#include <string>

namespace voxsheet::sheet {

void perform(Workbook& workbook, const SetStyle& command, const KeyTable& keys);
void perform(Workbook& workbook, const SetSource& command);
void perform(Workbook& workbook, const SetTitle& command);
void perform(Workbook& workbook, const SetWorkbookTitle& command);
void perform(Workbook& workbook, const SetLayout& command);
void perform(Workbook& workbook, const SetLevels& command);
void perform(Workbook& workbook, const InsertLines& command);
void perform(Workbook& workbook, const DeleteLines& command);
void perform(Workbook& workbook, const ClearCells& command);
void perform(Workbook& workbook, const MoveCells& command);
void perform(Workbook& workbook, const SwapCells& command);
void perform(Workbook& workbook, const AddDatasets& command);
void perform(Workbook& workbook, const UpdateDataset& command);
void perform(Workbook& workbook, const RemoveDataset& command);
void perform(Workbook& workbook, const RenameDataset& command);
void perform(Workbook& workbook, const ReplacePathPrefix& command);
void perform(Workbook& workbook, const AddSheet& command);
void perform(Workbook& workbook, const RenameSheet& command);
void perform(Workbook& workbook, const DeleteSheet& command);
void perform(Workbook& workbook, const ReplaceWorkbook& command);

// Shared by them.

[[nodiscard]] Sheet& editSheet(Workbook& workbook, const std::string& name);
/// Throws NotFound if the layer is outside the sheet, InvalidInput if it is no layer of the workbook.
void requireLayer(const Sheet& sheet, const Layer& layer);
/// Removes the cell if nothing is left in it.
void dropIfBlank(Sheet& sheet, const Address& address);
/// Applies to references to cells of `sheet`, wherever in the workbook they stand, in formulas or in styles.
/// nullopt: #REF!.
using CellsMove = std::function<std::optional<AddressRange>(const AddressRange&)>;
void moveReferences(Workbook& workbook, const std::string& sheet, const CellsMove& move);

} // namespace voxsheet::sheet
