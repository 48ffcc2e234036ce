#include "sheet/address.h"

#include "base/errors.h"
#include "sheet/utf8.h"

#include <algorithm>
#include <cctype>

namespace voxsheet::sheet {

namespace {

bool isLetter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

InvalidInput notAnAddress(std::string_view text, const char* what) {
    return InvalidInput(inQuotes(text), std::string("is not ") + what,
                        "use addresses such as A1, A1:C3 or Sheet2!B4");
}

std::size_t letterCount(std::string_view text) {
    return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), isLetter) - text.begin());
}

bool isPlainWord(std::string_view name) {
    return !name.empty() && !isDigit(name.front()) && std::all_of(name.begin(), name.end(), [](char c) {
        return isLetter(c) || isDigit(c) || c == '_';
    });
}

/// "B2" could be taken for a cell, "Sheet2" is beyond the last column.
bool couldBeCell(std::string_view name) {
    constexpr std::size_t lettersOfLastColumn = 3;
    return looksLikeAddress(name) && letterCount(name) <= lettersOfLastColumn;
}

} // namespace

int parseColumn(std::string_view text) {
    if (text.empty() || letterCount(text) != text.size()) throw notAnAddress(text, "a column");
    int column = 0;
    for (const char c : text) {
        column = column * 26 + (upper(c) - 'A' + 1);
        if (column > kMaxColumns)
            throw InvalidInput("column " + inQuotes(text), "is beyond the last column",
                               "the last one is " + columnName(kMaxColumns - 1));
    }
    return column - 1;
}

int parseRow(std::string_view text) {
    if (text.empty() || !std::all_of(text.begin(), text.end(), isDigit) || text.front() == '0')
        throw notAnAddress(text, "a row");
    int row = 0;
    for (const char c : text) {
        row = row * 10 + (c - '0');
        if (row > kMaxRows)
            throw InvalidInput("row " + inQuotes(text), "is beyond the last row",
                               "the last one is " + rowName(kMaxRows - 1));
    }
    return row - 1;
}

bool looksLikeAddress(std::string_view text) {
    const std::size_t letters = letterCount(text);
    return letters > 0 && letters < text.size() &&
           std::all_of(text.begin() + static_cast<std::ptrdiff_t>(letters), text.end(), isDigit);
}

Address parseAddress(std::string_view text) {
    if (!looksLikeAddress(text)) throw notAnAddress(text, "a cell");
    const std::size_t letters = letterCount(text);
    return {parseColumn(text.substr(0, letters)), parseRow(text.substr(letters))};
}

SheetAddress parseSheetAddress(std::string_view text) {
    const std::size_t bang = text.rfind('!');
    if (bang == std::string_view::npos) return {{}, parseAddress(text)};
    std::string_view name = text.substr(0, bang);
    if (name.size() >= 2 && name.front() == '\'' && name.back() == '\'')
        name = name.substr(1, name.size() - 2);
    else if (!isPlainWord(name))
        throw notAnAddress(text, "a cell of a sheet");
    validateSheetName(name);
    return {std::string(name), parseAddress(text.substr(bang + 1))};
}

AddressRange parseRange(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) {
        const Address cell = parseAddress(text);
        return {cell, cell};
    }
    const Address a = parseAddress(text.substr(0, colon));
    const Address b = parseAddress(text.substr(colon + 1));
    return {{std::min(a.column, b.column), std::min(a.row, b.row)},
            {std::max(a.column, b.column), std::max(a.row, b.row)}};
}

std::string columnName(int column) {
    std::string name;
    for (int rest = column + 1; rest > 0; rest = (rest - 1) / 26)
        name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % 26));
    return name;
}

std::string rowName(int row) { return std::to_string(row + 1); }

std::string addressName(const Address& address) { return columnName(address.column) + rowName(address.row); }

std::string addressName(const SheetAddress& address) {
    if (address.sheet.empty()) return addressName(address.cell);
    const bool quote = !isPlainWord(address.sheet) || couldBeCell(address.sheet);
    return (quote ? "'" + address.sheet + "'" : address.sheet) + "!" + addressName(address.cell);
}

std::string rangeName(const AddressRange& range) {
    if (range.first == range.last) return addressName(range.first);
    return addressName(range.first) + ":" + addressName(range.last);
}

void validateSheetName(std::string_view name) {
    const auto fail = [&](const char* why) {
        throw InvalidInput("sheet name " + inQuotes(name), why, "choose another name").withField("name");
    };
    if (name.empty() || name.size() > 64) fail("must have 1 to 64 bytes");
    if (!isValidUtf8(name)) fail("is not UTF-8");
    if (hasControlCharacter(name)) fail("holds a control character");
    if (name.front() == ' ' || name.back() == ' ') fail("begins or ends with a space");
    if (name.find_first_of("!'[]:/\\?*") != std::string_view::npos) fail("holds one of ! ' [ ] : / \\ ? *");
}

} // namespace voxsheet::sheet
