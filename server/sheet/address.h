// Spreadsheet addresses: columns A, B, …, Z, AA, …; rows 1, 2, …; `A1`, `A1:C3`, `Sheet2!B4`, `'My
// sheet'!B4`.
#pragma once

#include <compare>
#include <string>
#include <string_view>

namespace voxsheet::sheet {

inline constexpr int kMaxColumns = 1024; ///< A … AMJ
inline constexpr int kMaxRows = 1024;

/// A cell of one sheet, counted from 0. Ordered as read: row by row, left to right.
struct Address {
    int column = 0; ///< [0, kMaxColumns)
    int row = 0;    ///< [0, kMaxRows)

    bool operator==(const Address&) const = default;
    std::strong_ordering operator<=>(const Address& other) const {
        if (const auto order = row <=> other.row; order != 0) return order;
        return column <=> other.column;
    }
};

/// A cell of a named sheet; an empty name means "this sheet".
struct SheetAddress {
    std::string sheet;
    Address cell;

    bool operator==(const SheetAddress&) const = default;
    auto operator<=>(const SheetAddress&) const = default;
};

/// A rectangle of cells, both corners included; first.column <= last.column and first.row <= last.row.
struct AddressRange {
    Address first;
    Address last;

    bool operator==(const AddressRange&) const = default;
    [[nodiscard]] int columns() const { return last.column - first.column + 1; }
    [[nodiscard]] int rows() const { return last.row - first.row + 1; }
    [[nodiscard]] bool contains(const Address& cell) const {
        return cell.column >= first.column && cell.column <= last.column && cell.row >= first.row &&
               cell.row <= last.row;
    }
};

/// Letters are accepted in either case. All throw InvalidInput for anything but a whole address inside the
/// limits.
[[nodiscard]] int parseColumn(std::string_view text); ///< "A" -> 0
[[nodiscard]] int parseRow(std::string_view text);    ///< "1" -> 0
[[nodiscard]] Address parseAddress(std::string_view text);
[[nodiscard]] SheetAddress parseSheetAddress(std::string_view text);
/// `A1:C3`, corners in any order, or a single cell.
[[nodiscard]] AddressRange parseRange(std::string_view text);

/// True if the text has the form of an address (letters, then digits), whether inside the limits or not.
[[nodiscard]] bool looksLikeAddress(std::string_view text);

[[nodiscard]] std::string columnName(int column); ///< 0 -> "A"
[[nodiscard]] std::string rowName(int row);       ///< 0 -> "1"
[[nodiscard]] std::string addressName(const Address& address);
/// Quotes the sheet's name where a formula needs quotes.
[[nodiscard]] std::string addressName(const SheetAddress& address);
/// "A1:C3", or "A1" for a single cell.
[[nodiscard]] std::string rangeName(const AddressRange& range);

/// 1 to 64 bytes of UTF-8 with no control character, no leading or trailing space and none of `! ' [ ] : /
/// \ ? *`. Throws InvalidInput.
void validateSheetName(std::string_view name);

} // namespace voxsheet::sheet
