#include "base/errors.h"
#include "sheet/command_steps.h"
#include "sheet/formula/references.h"
#include "sheet/style_references.h"
#include "sheet/utf8.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

bool hasSheet(const Workbook& workbook, const std::string& name) {
    return std::any_of(workbook.sheets.begin(), workbook.sheets.end(),
                       [&](const Sheet& sheet) { return lowerAscii(sheet.name) == lowerAscii(name); });
}

void requireFreeSheetName(const Workbook& workbook, const std::string& name) {
    validateSheetName(name);
    if (hasSheet(workbook, name))
        throw Conflict("sheet " + inQuotes(name), "exists already", "choose another name").withField("name");
}

void rewriteAll(Workbook& workbook, const std::string& from, const std::string& to) {
    for (Sheet& sheet : workbook.sheets) {
        for (auto& [address, cell] : sheet.cells)
            if (cell.isFormula()) cell.source = rewriteSheet(cell.source, from, to);
        forEachStyle(sheet, [&](StyleMap& style) { renameSheetInStyle(style, from, to); });
    }
}

} // namespace

void perform(Workbook& workbook, const AddSheet& command) {
    Sheet sheet;
    sheet.name = command.name;
    for (std::size_t i = workbook.sheets.size() + 1; sheet.name.empty(); ++i)
        if (!hasSheet(workbook, "Sheet" + std::to_string(i))) sheet.name = "Sheet" + std::to_string(i);
    requireFreeSheetName(workbook, sheet.name);
    workbook.sheets.push_back(std::move(sheet));
}

void perform(Workbook& workbook, const RenameSheet& command) {
    Sheet& sheet = editSheet(workbook, command.name);
    const std::string old = sheet.name;
    // Only its letters' case may change without being a second sheet of that name.
    if (lowerAscii(old) != lowerAscii(command.newName)) requireFreeSheetName(workbook, command.newName);
    sheet.name = command.newName;
    rewriteAll(workbook, old, command.newName);
}

void perform(Workbook& workbook, const DeleteSheet& command) {
    const std::size_t index = sheetIndex(workbook, command.name);
    if (workbook.sheets.size() == 1)
        throw Conflict("the last sheet", "cannot be deleted", "add another one first");
    const std::string name = workbook.sheets[index].name;
    workbook.sheets.erase(workbook.sheets.begin() + static_cast<std::ptrdiff_t>(index));
    rewriteAll(workbook, name, {});
}

void perform(Workbook& workbook, const SetLevels& command) {
    if (command.levels) validateLevelSettings(*command.levels);
    editSheet(workbook, command.sheet).levels = command.levels;
}

void perform(Workbook& workbook, const ReplaceWorkbook& command) {
    if (!command.workbook) throw InvalidInput("workbook", "is absent");
    workbook = *command.workbook;
}

} // namespace voxsheet::sheet
