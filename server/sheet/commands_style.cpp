#include "base/errors.h"
#include "sheet/command_steps.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

StyleMap& editStyle(Sheet& sheet, const Layer& layer) {
    switch (layer.kind) {
    case LayerKind::Column:
        return sheet.columnHeaders[layer.column].style;
    case LayerKind::Row:
        return sheet.rowHeaders[layer.row].style;
    case LayerKind::Cell:
        return sheet.cells[{layer.column, layer.row}].style;
    default:
        return sheet.style;
    }
}

void dropBlankHeaders(std::map<int, Header>& headers) {
    std::erase_if(headers, [](const auto& entry) { return entry.second.isBlank(); });
}

void dropBlank(Sheet& sheet) {
    dropBlankHeaders(sheet.columnHeaders);
    dropBlankHeaders(sheet.rowHeaders);
    std::erase_if(sheet.cells, [](const auto& entry) { return entry.second.isBlank(); });
}

bool concerns(const Layer& layer, const Address& address) {
    switch (layer.kind) {
    case LayerKind::Column:
        return address.column == layer.column;
    case LayerKind::Row:
        return address.row == layer.row;
    case LayerKind::Cell:
        return address == Address{layer.column, layer.row};
    default:
        return true;
    }
}

void clearNearerValues(Sheet& sheet, const SetStyle& command) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : command.patch)
        keys.push_back(key);
    // One value may hide another that also hides the edit, so ask until none is left.
    for (auto hidden = hiddenBy(sheet, command.layer, keys); !hidden.empty();
         hidden = hiddenBy(sheet, command.layer, keys))
        for (const HiddenBy& item : hidden)
            editStyle(sheet, item.nearer).erase(item.key);
}

/// Only cells with content, and the layer itself: nothing else is drawn.
void requireCellsConsistent(const Sheet& sheet, const Layer& layer, const KeyTable& keys) {
    requireConsistent(typedStyle(resolveLayer(keys, sheet, layer)));
    for (const auto& [address, cell] : sheet.cells)
        if (!cell.source.empty() && concerns(layer, address))
            requireConsistent(resolveStyle(keys, sheet, address).style);
}

/// Keys that must agree, or have a form of their own. A camera drag need not pay for the check.
bool touchesChecked(const StylePatch& patch) {
    return std::any_of(patch.begin(), patch.end(), [](const auto& entry) {
        return entry.first == "transfer.cut1" || entry.first == "transfer.cut2" ||
               entry.first.starts_with("range.") || entry.first == "overlay.min" ||
               entry.first == "overlay.max" || entry.first == "labels.names";
    });
}

} // namespace

void perform(Workbook& workbook, const SetStyle& command, const KeyTable& keys) {
    Sheet& sheet = editSheet(workbook, command.sheet);
    requireLayer(sheet, command.layer);
    StyleMap& style = editStyle(sheet, command.layer);
    for (const auto& [name, value] : command.patch) {
        const KeySpec& key = keys.at(name);
        if (!value) {
            style.erase(name);
            continue;
        }
        validateStyleValue(key, *value);
        style[name] = *value;
    }
    if (command.clearNearer) clearNearerValues(sheet, command);
    dropBlank(sheet);
    if (touchesChecked(command.patch)) requireCellsConsistent(sheet, command.layer, keys);
}

} // namespace voxsheet::sheet
