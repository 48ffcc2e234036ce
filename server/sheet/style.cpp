#include "sheet/style.h"

#include "base/errors.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

namespace {

const StyleMap& emptyStyle() {
    static const StyleMap none;
    return none;
}

const StyleMap& headerStyle(const std::map<int, Header>& headers, int line) {
    const auto found = headers.find(line);
    return found == headers.end() ? emptyStyle() : found->second.style;
}

const StyleMap& cellStyle(const Sheet& sheet, const Address& address) {
    const Cell* cell = sheet.find(address);
    return cell ? cell->style : emptyStyle();
}

void requireInside(const Sheet& sheet, const Layer& layer) {
    const bool usesColumn = layer.kind == LayerKind::Column || layer.kind == LayerKind::Cell;
    const bool usesRow = layer.kind == LayerKind::Row || layer.kind == LayerKind::Cell;
    const bool inside = (!usesColumn || (layer.column >= 0 && layer.column < sheet.columns)) &&
                        (!usesRow || (layer.row >= 0 && layer.row < sheet.rows));
    if (!inside)
        throw NotFound(layerName(layer), "is outside the sheet \"" + sheet.name + "\"",
                       "its last cell is " + addressName(Address{sheet.columns - 1, sheet.rows - 1}));
}

ResolvedValues defaults(const KeyTable& keys) {
    ResolvedValues values;
    for (const KeySpec& key : keys.keys())
        values[key.name] = {key.defaultValue, {LayerKind::Default, 0, 0}};
    return values;
}

void lay(ResolvedValues& values, const StyleMap& style, const Layer& layer) {
    for (const auto& [key, value] : style) {
        // A key that the table does not have cannot come from a parsed document; an overlay may only set
        // known keys.
        const auto found = values.find(key);
        if (found == values.end())
            throw InvalidInput("style key \"" + key + "\"", "is not known").withField(key);
        found->second = {value, layer};
    }
}

} // namespace

std::string layerName(const Layer& layer) {
    const Address cell{layer.column, layer.row};
    switch (layer.kind) {
    case LayerKind::Default:
        return "default";
    case LayerKind::Sheet:
        return "sheet";
    case LayerKind::PageView:
        return "view";
    case LayerKind::Column:
        return "column " + columnName(layer.column);
    case LayerKind::Row:
        return "row " + rowName(layer.row);
    case LayerKind::Cell:
        return "cell " + addressName(cell);
    case LayerKind::PageCell:
        return "view of " + addressName(cell);
    case LayerKind::Request:
        break;
    }
    return "request";
}

ResolvedStyle resolveStyle(const KeyTable& keys, const Sheet& sheet, const Address& address,
                           const StyleOverlay& overlay) {
    requireInside(sheet, Layer::ofCell(address));
    ResolvedStyle resolved;
    resolved.values = defaults(keys);
    lay(resolved.values, sheet.style, Layer::sheet());
    lay(resolved.values, overlay.view, {LayerKind::PageView, 0, 0});
    lay(resolved.values, headerStyle(sheet.columnHeaders, address.column), Layer::ofColumn(address.column));
    lay(resolved.values, headerStyle(sheet.rowHeaders, address.row), Layer::ofRow(address.row));
    lay(resolved.values, cellStyle(sheet, address), Layer::ofCell(address));
    if (const auto own = overlay.cells.find(address); own != overlay.cells.end())
        lay(resolved.values, own->second, {LayerKind::PageCell, address.column, address.row});
    lay(resolved.values, overlay.request, {LayerKind::Request, 0, 0});
    resolved.style = typedStyle(resolved.values);
    return resolved;
}

ResolvedStyle defaultStyle(const KeyTable& keys) {
    ResolvedStyle resolved;
    resolved.values = defaults(keys);
    resolved.style = typedStyle(resolved.values);
    return resolved;
}

ResolvedValues resolveLayer(const KeyTable& keys, const Sheet& sheet, const Layer& layer) {
    if (layer.kind == LayerKind::Cell) return resolveStyle(keys, sheet, {layer.column, layer.row}).values;
    ResolvedValues values = defaults(keys);
    lay(values, sheet.style, Layer::sheet());
    if (layer.kind != LayerKind::Sheet) lay(values, ownStyle(sheet, layer), layer);
    return values;
}

const StyleMap& ownStyle(const Sheet& sheet, const Layer& layer) {
    requireInside(sheet, layer);
    switch (layer.kind) {
    case LayerKind::Sheet:
        return sheet.style;
    case LayerKind::Column:
        return headerStyle(sheet.columnHeaders, layer.column);
    case LayerKind::Row:
        return headerStyle(sheet.rowHeaders, layer.row);
    case LayerKind::Cell:
        return cellStyle(sheet, {layer.column, layer.row});
    case LayerKind::Default:
    case LayerKind::PageView:
    case LayerKind::PageCell:
    case LayerKind::Request:
        break;
    }
    throw InvalidInput("layer \"" + layerName(layer) + "\"", "is not part of the workbook",
                       "use the sheet, a column, a row or a cell");
}

std::vector<HiddenBy> hiddenBy(const Sheet& sheet, const Layer& edited,
                               const std::vector<std::string>& keys) {
    std::vector<HiddenBy> hidden;
    const auto note = [&](const std::string& key, const Layer& nearer, const Address& cell) {
        const auto found = std::find_if(hidden.begin(), hidden.end(), [&](const HiddenBy& h) {
            return h.key == key && h.nearer == nearer;
        });
        if (found != hidden.end())
            found->cells.push_back(cell);
        else
            hidden.push_back({key, nearer, {cell}});
    };
    for (const auto& [address, cell] : sheet.cells) {
        if (cell.source.empty()) continue;
        if (edited.kind == LayerKind::Column && address.column != edited.column) continue;
        if (edited.kind == LayerKind::Row && address.row != edited.row) continue;
        if (edited.kind == LayerKind::Cell) continue; // nothing is nearer
        for (const std::string& key : keys) {
            if (cell.style.contains(key))
                note(key, Layer::ofCell(address), address);
            else if (edited.kind != LayerKind::Row &&
                     headerStyle(sheet.rowHeaders, address.row).contains(key))
                note(key, Layer::ofRow(address.row), address);
            else if (edited.kind == LayerKind::Sheet &&
                     headerStyle(sheet.columnHeaders, address.column).contains(key))
                note(key, Layer::ofColumn(address.column), address);
        }
    }
    return hidden;
}

std::string hiddenSentence(const std::vector<HiddenBy>& hidden) {
    std::string text;
    std::string key;
    for (const HiddenBy& item : hidden) {
        if (item.key != key)
            text += (text.empty() ? "" : "; ") + item.key + " is set nearer by " + layerName(item.nearer);
        else
            text += ", " + layerName(item.nearer);
        key = item.key;
    }
    return text;
}

std::vector<Override> listOverrides(const Sheet& sheet) {
    std::vector<Override> list;
    const auto add = [&](const Layer& layer, const StyleMap& style) {
        for (const auto& [key, value] : style)
            list.push_back({layer, key, value});
    };
    for (const auto& [column, header] : sheet.columnHeaders)
        add(Layer::ofColumn(column), header.style);
    for (const auto& [row, header] : sheet.rowHeaders)
        add(Layer::ofRow(row), header.style);
    for (const auto& [address, cell] : sheet.cells)
        add(Layer::ofCell(address), cell.style);
    return list;
}

nlohmann::json resolvedToJson(const ResolvedValues& values, const Layer& layer) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [key, resolved] : values)
        object[key] = {{"value", styleValueToJson(resolved.value)},
                       {"origin", layerName(resolved.origin)},
                       {"own", resolved.origin == layer}};
    return object;
}

} // namespace voxsheet::sheet
