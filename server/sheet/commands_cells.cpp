#include "base/errors.h"
#include "sheet/command_steps.h"
#include "sheet/layout.h"
#include "sheet/utf8.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

void requireCell(const Sheet& sheet, const Address& address) { requireLayer(sheet, Layer::ofCell(address)); }

void setHeaderTitle(std::map<int, Header>& headers, int line, const std::string& title) {
    headers[line].title = title;
    if (headers[line].isBlank()) headers.erase(line);
}

AddressRange shifted(const AddressRange& range, int columns, int rows) {
    return {{range.first.column + columns, range.first.row + rows},
            {range.last.column + columns, range.last.row + rows}};
}

void grow(Sheet& sheet, const Address& last) {
    if (last.column >= kMaxColumns || last.row >= kMaxRows)
        throw LimitExceeded("cell " + addressName(last), "is beyond what a sheet can have",
                            "choose a nearer cell");
    sheet.columns = std::max(sheet.columns, last.column + 1);
    sheet.rows = std::max(sheet.rows, last.row + 1);
}

/// Copies of the cells of a range, which are then gone from the sheet.
std::map<Address, Cell> takeCells(Sheet& sheet, const AddressRange& range) {
    std::map<Address, Cell> taken;
    for (auto it = sheet.cells.begin(); it != sheet.cells.end();) {
        if (!range.contains(it->first)) {
            ++it;
            continue;
        }
        taken.insert(*it);
        it = sheet.cells.erase(it);
    }
    return taken;
}

} // namespace

void perform(Workbook& workbook, const SetSource& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    requireCell(sheet, command.cell);
    const bool formula = command.source.starts_with("=");
    if (!formula && !command.source.empty() && !workbook.datasets.contains(command.source))
        throw NotFound("dataset " + inQuotes(command.source), "is not in the workbook",
                       "add it first, or begin a formula with =")
            .withField("source");
    sheet.cells[command.cell].source = command.source;
    dropIfBlank(sheet, command.cell);
}

void perform(Workbook& workbook, const SetTitle& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    requireLayer(sheet, command.layer);
    const Address cell{command.layer.column, command.layer.row};
    switch (command.layer.kind) {
    case LayerKind::Column:
        setHeaderTitle(sheet.columnHeaders, command.layer.column, command.title);
        break;
    case LayerKind::Row:
        setHeaderTitle(sheet.rowHeaders, command.layer.row, command.title);
        break;
    case LayerKind::Cell:
        sheet.cells[cell].title = command.title;
        dropIfBlank(sheet, cell);
        break;
    default:
        sheet.title = command.title;
        break;
    }
}

void perform(Workbook& workbook, const SetWorkbookTitle& command) { workbook.title = command.title; }

void perform(Workbook& workbook, const SetLayout& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    const Layout layout = layoutWithColumns(sheet.cells.size(), command.columns);
    std::map<Address, Cell> cells;
    std::map<Address, Address> moves;
    int index = 0;
    for (auto& [address, cell] : sheet.cells) {
        const Address to{index % layout.columns, index / layout.columns};
        moves[address] = to;
        cells.emplace(to, std::move(cell));
        ++index;
    }
    sheet.cells = std::move(cells);
    sheet.columns = layout.columns;
    sheet.rows = layout.rows;
    sheet.autoLayout = false;
    std::erase_if(sheet.columnHeaders, [&](const auto& entry) { return entry.first >= layout.columns; });
    std::erase_if(sheet.rowHeaders, [&](const auto& entry) { return entry.first >= layout.rows; });
    moveReferences(workbook, command.sheet, [&](const AddressRange& range) -> std::optional<AddressRange> {
        if (range.first != range.last) return range;
        const auto found = moves.find(range.first);
        if (found == moves.end()) return std::nullopt;
        return AddressRange{found->second, found->second};
    });
}

void perform(Workbook& workbook, const ClearCells& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    requireCell(sheet, command.range.first);
    requireCell(sheet, command.range.last);
    (void)takeCells(sheet, command.range);
}

void perform(Workbook& workbook, const MoveCells& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    requireCell(sheet, command.from.first);
    requireCell(sheet, command.from.last);
    const int columns = command.to.column - command.from.first.column;
    const int rows = command.to.row - command.from.first.row;
    const AddressRange target = shifted(command.from, columns, rows);
    if (target.first.column < 0 || target.first.row < 0)
        throw NotFound("cell to move to", "is outside the sheet", "choose a cell inside it");
    grow(sheet, target.last);
    const std::map<Address, Cell> moving = takeCells(sheet, command.from);
    (void)takeCells(sheet, target);
    for (const auto& [address, cell] : moving)
        sheet.cells[{address.column + columns, address.row + rows}] = cell;
    moveReferences(workbook, command.sheet, [&](const AddressRange& range) -> std::optional<AddressRange> {
        if (command.from.contains(range.first) && command.from.contains(range.last))
            return shifted(range, columns, rows);
        if (target.contains(range.first) && target.contains(range.last)) return std::nullopt;
        return range;
    });
}

void perform(Workbook& workbook, const SwapCells& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    requireCell(sheet, command.first);
    requireCell(sheet, command.second);
    std::swap(sheet.cells[command.first], sheet.cells[command.second]);
    dropIfBlank(sheet, command.first);
    dropIfBlank(sheet, command.second);
    moveReferences(workbook, command.sheet, [&](const AddressRange& range) -> std::optional<AddressRange> {
        if (range == AddressRange{command.first, command.first})
            return AddressRange{command.second, command.second};
        if (range == AddressRange{command.second, command.second})
            return AddressRange{command.first, command.first};
        return range;
    });
}

} // namespace voxsheet::sheet
