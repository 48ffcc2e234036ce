#include "sheet/workbook.h"

#include "base/errors.h"
#include "sheet/bounded_json.h"
#include "sheet/utf8.h"

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

namespace {

[[noreturn]] void refuse(const std::string& field, const std::string& why, const std::string& toDo) {
    throw InvalidInput(field, why, toDo).withField(field);
}

void validateText(const std::string& field, std::string_view text, std::size_t longest) {
    if (text.size() > longest)
        refuse(field, "is longer than " + std::to_string(longest) + " bytes", "shorten it");
    if (!isValidUtf8(text)) refuse(field, "is not UTF-8", "save the text as UTF-8");
    if (hasControlCharacter(text)) refuse(field, "holds a control character", "remove it");
}

void validateHeaders(const std::string& field, const std::map<int, Header>& headers, int count,
                     bool columns) {
    for (const auto& [line, header] : headers) {
        const std::string path = field + "." + (columns ? columnName(line) : rowName(line));
        if (line < 0 || line >= count) refuse(path, "is outside the sheet", "enlarge the sheet or remove it");
        if (header.isBlank()) refuse(path, "holds nothing", "remove it");
        validateText(path + ".title", header.title, kMaxTitleBytes);
    }
}

void validateCell(const Sheet& sheet, const std::string& path, const Address& address, const Cell& cell,
                  const Workbook& workbook) {
    if (!sheet.contains(address)) refuse(path, "is outside the sheet", "enlarge the sheet or move the cell");
    if (cell.isBlank()) refuse(path, "holds nothing", "remove it");
    validateText(path + ".title", cell.title, kMaxTitleBytes);
    validateText(path + ".source", cell.source, kMaxFormulaBytes);
    if (cell.isDataset() && !workbook.datasets.contains(cell.source))
        refuse(path + ".source",
               "names the dataset " + inQuotes(cell.source) + ", which is not in the workbook",
               "add it to datasets, or begin a formula with =");
}

void validateLevels(const std::string& path, const LevelSettings& levels) {
    try {
        validateLevelSettings(levels);
    } catch (const InvalidInput& error) {
        refuse(path + "." + error.field(), error.why(), error.toDo());
    }
}

void validateSheet(const Workbook& workbook, std::size_t index) {
    const Sheet& sheet = workbook.sheets[index];
    const std::string path = "sheets[" + std::to_string(index) + "]";
    validateSheetName(sheet.name);
    for (std::size_t other = 0; other < index; ++other)
        if (lowerAscii(workbook.sheets[other].name) == lowerAscii(sheet.name))
            refuse(path + ".name", inQuotes(sheet.name) + " is the name of two sheets", "rename one");
    validateText(path + ".title", sheet.title, kMaxTitleBytes);
    if (sheet.columns < 1 || sheet.columns > kMaxColumns)
        refuse(path + ".columns", "is not from 1 to " + std::to_string(kMaxColumns), "give such a number");
    if (sheet.rows < 1 || sheet.rows > kMaxRows)
        refuse(path + ".rows", "is not from 1 to " + std::to_string(kMaxRows), "give such a number");
    if (static_cast<std::size_t>(sheet.columns) * static_cast<std::size_t>(sheet.rows) > kMaxCells)
        refuse(path, "has more than " + std::to_string(kMaxCells) + " cells", "use several sheets");
    if (sheet.levels) validateLevels(path + ".levels", *sheet.levels);
    validateHeaders(path + ".columnHeaders", sheet.columnHeaders, sheet.columns, true);
    validateHeaders(path + ".rowHeaders", sheet.rowHeaders, sheet.rows, false);
    for (const auto& [address, cell] : sheet.cells)
        validateCell(sheet, path + ".cells." + addressName(address), address, cell, workbook);
}

void validateSource(const std::string& name, const DatasetSource& source) {
    const std::string path = "datasets." + replaceInvalidUtf8(name);
    validateDatasetName(name);
    if (source.files.empty()) refuse(path + ".files", "is empty", "name at least one file");
    for (const std::string& file : source.files) {
        if (file.empty()) refuse(path + ".files", "holds an empty name", "name the file");
        if (!isValidUtf8(file) || file.find('\0') != std::string::npos)
            refuse(path + ".files", inQuotes(file) + " is not UTF-8", "rename the file");
    }
    validateText(path + ".checksum", source.checksum, 200);
    const bool isObject = parseBoundedJson(source.options, path + ".options", {65536, 16}).is_object();
    if (!isObject) refuse(path + ".options", "is no JSON object", "give import options as an object");
}

} // namespace

const Cell* Sheet::find(const Address& address) const {
    const auto found = cells.find(address);
    return found == cells.end() ? nullptr : &found->second;
}

bool Workbook::operator==(const Workbook& other) const {
    return title == other.title && sheets == other.sheets && datasets == other.datasets;
}

std::size_t sheetIndex(const Workbook& workbook, std::string_view name) {
    std::string names;
    for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
        if (lowerAscii(workbook.sheets[i].name) == lowerAscii(name)) return i;
        names += (i == 0 ? "" : ", ") + workbook.sheets[i].name;
    }
    throw NotFound("sheet " + inQuotes(name), "does not exist", "there is: " + names);
}

const Sheet& sheetNamed(const Workbook& workbook, std::string_view name) {
    return workbook.sheets[sheetIndex(workbook, name)];
}

void validateDatasetName(std::string_view name) {
    const auto fail = [&](const char* why) {
        throw InvalidInput("dataset name " + inQuotes(name), why, "choose another name").withField("name");
    };
    if (name.empty() || name.size() > 200) fail("must have 1 to 200 bytes");
    if (!isValidUtf8(name)) fail("is not UTF-8");
    if (hasControlCharacter(name)) fail("holds a control character");
    if (name.front() == ' ' || name.back() == ' ') fail("begins or ends with a space");
    if (name.front() == '=') fail("begins with =, as only formulas do");
}

void validateWorkbook(const Workbook& workbook) {
    validateText("title", workbook.title, kMaxTitleBytes);
    if (workbook.sheets.empty()) refuse("sheets", "is empty", "give at least one sheet");
    if (workbook.sheets.size() > kMaxSheets)
        refuse("sheets", "holds more than " + std::to_string(kMaxSheets) + " sheets",
               "use several workbooks");
    for (const auto& [name, source] : workbook.datasets)
        validateSource(name, source);
    for (std::size_t i = 0; i < workbook.sheets.size(); ++i)
        validateSheet(workbook, i);
}

std::string cellTitle(const Cell& cell) { return cell.title.empty() ? cell.source : cell.title; }

} // namespace voxsheet::sheet
