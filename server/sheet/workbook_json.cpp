#include "sheet/workbook_json.h"

#include "base/errors.h"
#include "sheet/bounded_json.h"
#include "sheet/json_reader.h"
#include "sheet/level_settings_json.h"
#include "sheet/utf8.h"

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

ordered_json styleToOrdered(const StyleMap& style) {
    ordered_json object = ordered_json::object();
    for (const auto& [key, value] : style)
        object[key] = ordered_json(styleValueToJson(value));
    return object;
}

ordered_json headerToJson(const Header& header) {
    ordered_json object = ordered_json::object();
    if (!header.title.empty()) object["title"] = header.title;
    if (!header.style.empty()) object["style"] = styleToOrdered(header.style);
    return object;
}

ordered_json sourceToJson(const DatasetSource& source) {
    ordered_json object{{"files", source.files}};
    if (source.bytes > 0) object["bytes"] = source.bytes;
    if (!source.checksum.empty()) object["checksum"] = source.checksum;
    const json options = parseBoundedJson(source.options, "options");
    if (!options.empty()) object["options"] = ordered_json(options);
    return object;
}

} // namespace

ordered_json cellToJson(const Cell& cell) {
    ordered_json object = ordered_json::object();
    if (!cell.source.empty()) object["source"] = cell.source;
    if (!cell.title.empty()) object["title"] = cell.title;
    if (!cell.style.empty()) object["style"] = styleToOrdered(cell.style);
    return object;
}

ordered_json sheetToJson(const Sheet& sheet) {
    ordered_json object{{"name", sheet.name}};
    if (!sheet.title.empty()) object["title"] = sheet.title;
    object["columns"] = sheet.columns;
    object["rows"] = sheet.rows;
    if (!sheet.autoLayout) object["autoLayout"] = false;
    if (!sheet.style.empty()) object["style"] = styleToOrdered(sheet.style);
    if (sheet.levels) object["levels"] = levelSettingsToJson(*sheet.levels);
    for (const auto& [column, header] : sheet.columnHeaders)
        object["columnHeaders"][columnName(column)] = headerToJson(header);
    for (const auto& [row, header] : sheet.rowHeaders)
        object["rowHeaders"][rowName(row)] = headerToJson(header);
    for (const auto& [address, cell] : sheet.cells)
        object["cells"][addressName(address)] = cellToJson(cell);
    return object;
}

ordered_json workbookToJson(const Workbook& workbook) {
    ordered_json document{{"voxsheet", kWorkbookFormat}};
    if (!workbook.title.empty()) document["title"] = workbook.title;
    for (const auto& [name, source] : workbook.datasets)
        document["datasets"][name] = sourceToJson(source);
    document["sheets"] = ordered_json::array();
    for (const Sheet& sheet : workbook.sheets)
        document["sheets"].push_back(sheetToJson(sheet));
    return document;
}

namespace {

StyleMap readStyle(const JsonReader& node, const KeyTable& keys) {
    try {
        return parseStyleMap(keys, node.value());
    } catch (const InvalidInput& error) {
        const std::string path = node.path() + (error.field() == "style" ? "" : "." + error.field());
        throw InvalidInput(path, error.why(), error.toDo()).withField(path);
    }
}

/// Reads a member's name as an address part; refuses a second spelling ("a1" beside "A1").
template <typename Parse, typename Map>
auto readAddress(const JsonReader& node, Parse parse, const Map& known) {
    try {
        const auto address = parse(node.name());
        if (known.contains(address)) node.refuse("is given twice", "keep one of them");
        return address;
    } catch (const InvalidInput& error) {
        if (!error.field().empty()) throw;
        node.refuse(error.why(), error.toDo());
    }
}

Header readHeader(const JsonReader& node, const KeyTable& keys) {
    node.allow({"title", "style"});
    Header header;
    if (const auto title = node.find("title")) header.title = title->text();
    if (const auto style = node.find("style")) header.style = readStyle(*style, keys);
    return header;
}

template <typename Parse>
std::map<int, Header> readHeaders(const JsonReader& node, const KeyTable& keys, Parse parse) {
    std::map<int, Header> headers;
    for (const JsonReader& member : node.members()) {
        const int line = readAddress(member, parse, headers);
        Header header = readHeader(member, keys);
        if (!header.isBlank()) headers.emplace(line, std::move(header));
    }
    return headers;
}

Cell readCell(const JsonReader& node, const KeyTable& keys) {
    node.allow({"source", "title", "style"});
    Cell cell;
    if (const auto source = node.find("source")) cell.source = source->text();
    if (const auto title = node.find("title")) cell.title = title->text();
    if (const auto style = node.find("style")) cell.style = readStyle(*style, keys);
    return cell;
}

Sheet readSheet(const JsonReader& node, const KeyTable& keys) {
    node.allow({"name", "title", "columns", "rows", "autoLayout", "style", "levels", "columnHeaders",
                "rowHeaders", "cells"});
    Sheet sheet;
    sheet.name = node.at("name").text();
    if (const auto title = node.find("title")) sheet.title = title->text();
    sheet.columns = static_cast<int>(node.at("columns").integer(1, kMaxColumns));
    sheet.rows = static_cast<int>(node.at("rows").integer(1, kMaxRows));
    if (const auto automatic = node.find("autoLayout")) sheet.autoLayout = automatic->boolean();
    if (const auto style = node.find("style")) sheet.style = readStyle(*style, keys);
    if (const auto levels = node.find("levels")) sheet.levels = levelSettingsFromJson(*levels);
    if (const auto headers = node.find("columnHeaders"))
        sheet.columnHeaders = readHeaders(*headers, keys, parseColumn);
    if (const auto headers = node.find("rowHeaders"))
        sheet.rowHeaders = readHeaders(*headers, keys, parseRow);
    if (const auto cells = node.find("cells")) {
        for (const JsonReader& member : cells->members()) {
            const Address address = readAddress(member, parseAddress, sheet.cells);
            Cell cell = readCell(member, keys);
            if (!cell.isBlank()) sheet.cells.emplace(address, std::move(cell));
        }
    }
    return sheet;
}

DatasetSource readSource(const JsonReader& node) {
    node.allow({"files", "bytes", "checksum", "options"});
    DatasetSource source;
    for (const JsonReader& file : node.at("files").items())
        source.files.push_back(file.text());
    if (const auto bytes = node.find("bytes"))
        source.bytes = static_cast<std::uint64_t>(bytes->integer(0, INT64_MAX));
    if (const auto checksum = node.find("checksum")) source.checksum = checksum->text();
    if (const auto options = node.find("options")) {
        options->requireObject();
        source.options = options->value().dump();
    }
    return source;
}

void requireFormat(const JsonReader& document) {
    const std::int64_t format = document.at("voxsheet").integer(1, INT64_MAX);
    if (format > kWorkbookFormat)
        throw Unsupported("workbook",
                          "has format " + std::to_string(format) + ", this program reads up to " +
                              std::to_string(kWorkbookFormat),
                          "open it with a newer Voxsheet")
            .withField("voxsheet");
}

} // namespace

Workbook workbookFromJson(const json& value, const KeyTable& keys) {
    const JsonReader document(value);
    document.requireObject();
    requireFormat(document);
    document.allow({"voxsheet", "title", "datasets", "sheets"});
    Workbook workbook;
    workbook.sheets.clear();
    if (const auto title = document.find("title")) workbook.title = title->text();
    if (const auto datasets = document.find("datasets"))
        for (const JsonReader& member : datasets->members())
            workbook.datasets[member.name()] = readSource(member);
    for (const JsonReader& item : document.at("sheets").items())
        workbook.sheets.push_back(readSheet(item, keys));
    validateWorkbook(workbook);
    return workbook;
}

std::string serialiseWorkbook(const Workbook& workbook) { return workbookToJson(workbook).dump(2) + "\n"; }

Workbook parseWorkbook(std::string_view text, const KeyTable& keys) {
    return workbookFromJson(parseBoundedJson(text, "workbook"), keys);
}

} // namespace voxsheet::sheet
