// The workbook: sheets of cells, their sources and their style layers. An immutable snapshot with a version;
// every edit makes a new one (commands.h, history.h), so that readers on any thread need no lock.
#pragma once

#include "resolution/level_settings.h"
#include "sheet/address.h"
#include "sheet/style_value.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::sheet {

inline constexpr std::size_t kMaxCells = 16384; ///< of one sheet: columns * rows
inline constexpr std::size_t kMaxSheets = 64;
inline constexpr std::size_t kMaxFormulaBytes = 8192;
inline constexpr std::size_t kMaxTitleBytes = 1000;

/// Where a dataset comes from.
struct DatasetSource {
    std::vector<std::string> files; ///< one, or a series in order; at least one; UTF-8
    std::uint64_t bytes = 0;        ///< of all files together; 0 = not known yet
    std::string checksum;           ///< "algorithm:hex"; empty = not known yet
    std::string options = "{}";     ///< import options: a JSON object as compact text with sorted members
    bool operator==(const DatasetSource&) const = default;
};

struct Cell {
    /// Empty; a dataset's name; or a formula, which begins with '='.
    std::string source;
    std::string title; ///< empty: the source's name
    StyleMap style;

    bool operator==(const Cell&) const = default;
    [[nodiscard]] bool isFormula() const { return !source.empty() && source.front() == '='; }
    [[nodiscard]] bool isDataset() const { return !source.empty() && source.front() != '='; }
    [[nodiscard]] bool isBlank() const { return source.empty() && title.empty() && style.empty(); }
};

/// Of one column or row.
struct Header {
    std::string title;
    StyleMap style;
    bool operator==(const Header&) const = default;
    [[nodiscard]] bool isBlank() const { return title.empty() && style.empty(); }
};

struct Sheet {
    std::string name = "Sheet1";
    std::string title;
    int columns = 1; ///< [1, kMaxColumns]; columns * rows <= kMaxCells
    int rows = 1;    ///< [1, kMaxRows]
    /// The sheet stays near-square as it grows. False once someone chose the columns: then it grows by rows
    /// only.
    bool autoLayout = true;
    StyleMap style;
    /// How the levels of detail of its cells are chosen on pages; absent: as the server was told at its
    /// start.
    std::optional<LevelSettings> levels;
    std::map<int, Header> columnHeaders; ///< by column, from 0; none of them blank
    std::map<int, Header> rowHeaders;    ///< by row, from 0; none of them blank
    std::map<Address, Cell> cells;       ///< inside columns x rows; none of them blank

    bool operator==(const Sheet&) const = default;
    [[nodiscard]] bool contains(const Address& a) const {
        return a.column >= 0 && a.column < columns && a.row >= 0 && a.row < rows;
    }
    /// nullptr for a blank cell.
    [[nodiscard]] const Cell* find(const Address& address) const;
};

struct Workbook {
    std::string title;
    std::vector<Sheet> sheets{Sheet{}}; ///< at least one; names unique, whatever their case
    std::map<std::string, DatasetSource> datasets;
    std::uint64_t version = 0; ///< set by History; no part of the document

    /// Of the document: the version does not matter.
    bool operator==(const Workbook& other) const;
};

/// Names match whatever the case of ASCII letters. Throws NotFound that lists the sheets.
[[nodiscard]] std::size_t sheetIndex(const Workbook& workbook, std::string_view name);
[[nodiscard]] const Sheet& sheetNamed(const Workbook& workbook, std::string_view name);

/// 1 to 200 bytes of UTF-8 with no control character, no leading or trailing space, not beginning with '='.
/// Throws InvalidInput.
void validateDatasetName(std::string_view name);

/// Every rule stated in this header. Throws InvalidInput with the member's path as field. Style values are
/// checked where they are parsed.
void validateWorkbook(const Workbook& workbook);

/// What a cell is called: its title, else its dataset's name, else its formula.
[[nodiscard]] std::string cellTitle(const Cell& cell);

} // namespace voxsheet::sheet
