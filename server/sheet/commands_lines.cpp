// Columns and rows come and go.
#include "base/errors.h"
#include "sheet/command_steps.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

int& along(Address& address, Axis axis) { return axis == Axis::Columns ? address.column : address.row; }
int& lineCount(Sheet& sheet, Axis axis) { return axis == Axis::Columns ? sheet.columns : sheet.rows; }
std::map<int, Header>& headersOf(Sheet& sheet, Axis axis) {
    return axis == Axis::Columns ? sheet.columnHeaders : sheet.rowHeaders;
}
std::string axisName(Axis axis) { return axis == Axis::Columns ? "column" : "row"; }

/// Where a line is afterwards; nullopt: gone.
using LineMove = std::function<std::optional<int>(int)>;

void moveLines(Sheet& sheet, Axis axis, const LineMove& move) {
    std::map<Address, Cell> cells;
    for (auto& [address, cell] : sheet.cells) {
        Address to = address;
        const std::optional<int> line = move(along(to, axis));
        if (!line) continue;
        along(to, axis) = *line;
        cells.emplace(to, std::move(cell));
    }
    sheet.cells = std::move(cells);
    std::map<int, Header> headers;
    for (auto& [line, header] : headersOf(sheet, axis))
        if (const std::optional<int> to = move(line)) headers.emplace(*to, std::move(header));
    headersOf(sheet, axis) = std::move(headers);
}

} // namespace

void perform(Workbook& workbook, const InsertLines& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    int& lines = lineCount(sheet, command.axis);
    const int most = command.axis == Axis::Columns ? kMaxColumns : kMaxRows;
    if (command.at < 0 || command.at > lines)
        throw NotFound("place to insert a " + axisName(command.axis), "is outside the sheet",
                       "choose one inside it");
    if (command.count < 1 || command.count > most - lines)
        throw LimitExceeded("inserting " + std::to_string(command.count) + " " + axisName(command.axis) + "s",
                            "is not possible: a sheet has at most " + std::to_string(most), "insert fewer");
    lines += command.count;
    const auto move = [&](int line) -> std::optional<int> {
        return line >= command.at ? line + command.count : line;
    };
    moveLines(sheet, command.axis, move);
    moveReferences(workbook, command.sheet, [&](const AddressRange& range) -> std::optional<AddressRange> {
        AddressRange moved = range;
        along(moved.first, command.axis) = *move(along(moved.first, command.axis));
        along(moved.last, command.axis) = *move(along(moved.last, command.axis));
        return moved;
    });
}

void perform(Workbook& workbook, const DeleteLines& command) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    int& lines = lineCount(sheet, command.axis);
    if (command.at < 0 || command.count < 1 || command.at >= lines || command.count > lines - command.at)
        throw NotFound(axisName(command.axis) + "s to delete", "are not all inside the sheet",
                       "choose some inside it");
    if (command.count == lines)
        throw InvalidInput("deleting every " + axisName(command.axis), "would leave no sheet",
                           "delete the sheet instead");
    lines -= command.count;
    const int end = command.at + command.count;
    const auto move = [&](int line) -> std::optional<int> {
        if (line < command.at) return line;
        if (line < end) return std::nullopt;
        return line - command.count;
    };
    moveLines(sheet, command.axis, move);
    moveReferences(workbook, command.sheet, [&](const AddressRange& range) -> std::optional<AddressRange> {
        AddressRange moved = range;
        const int first = along(moved.first, command.axis);
        const int last = along(moved.last, command.axis);
        if (first >= command.at && last < end) return std::nullopt;
        // A range that is cut keeps what is left of it.
        along(moved.first, command.axis) = move(first).value_or(command.at);
        along(moved.last, command.axis) = move(last).value_or(command.at - 1);
        return moved;
    });
}

} // namespace voxsheet::sheet
