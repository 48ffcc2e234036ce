// Edits. Each is a value; applying one to a snapshot gives the next. One drag is one undo step (history.h).
#pragma once

#include "sheet/style.h"
#include "sheet/style_keys.h"
#include "sheet/workbook.h"

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace voxsheet::sheet {

struct SetStyle {
    std::string sheet;
    Layer layer; ///< Sheet, Column, Row or Cell
    StylePatch patch;
    bool clearNearer = false; ///< also removes these keys from every nearer layer that would hide the edit
};

struct SetSource {
    std::string sheet;
    Address cell;
    std::string source; ///< empty, a dataset's name, or a formula that begins with '='
};

struct SetTitle {
    std::string sheet;
    Layer layer; ///< Sheet, Column, Row or Cell
    std::string title;
};

struct SetWorkbookTitle {
    std::string title;
};

/// Fills the cells with content, in reading order, into this many columns; formulas follow the cells that
/// move.
struct SetLayout {
    std::string sheet;
    int columns = 1;
};

enum class Axis { Columns, Rows };

/// How the levels of detail of the sheet's cells are chosen; absent: as the server was told at its start.
struct SetLevels {
    std::string sheet;
    std::optional<LevelSettings> levels;
};

/// Inserts blank columns or rows before `at`; formulas follow.
struct InsertLines {
    std::string sheet;
    Axis axis = Axis::Columns;
    int at = 0; ///< [0, number of lines]
    int count = 1;
};

/// Removes columns or rows; references to removed cells become #REF!.
struct DeleteLines {
    std::string sheet;
    Axis axis = Axis::Columns;
    int at = 0;
    int count = 1;
};

/// Empties cells: sources, titles and styles.
struct ClearCells {
    std::string sheet;
    AddressRange range;
};

/// Moves cells with their titles and styles over whatever is there; formulas follow the moved cells, and
/// references to cells that were overwritten become #REF!. The sheet grows when needed.
struct MoveCells {
    std::string sheet;
    AddressRange from;
    Address to; ///< of the range's first cell
};

/// Formulas follow both cells.
struct SwapCells {
    std::string sheet;
    Address first;
    Address second;
};

struct NamedDataset {
    std::string name;
    DatasetSource source;
    std::optional<Address> place; ///< not set: the next free cell
};

/// Registers datasets and puts each into a cell. A place that holds something already is a Conflict.
struct AddDatasets {
    std::string sheet;
    std::vector<NamedDataset> datasets;
    bool place = true;                     ///< false: only registered
    std::optional<int> columns;            ///< for a sheet that is still empty
    std::vector<std::string> columnTitles; ///< from column A; empty strings leave what is there
    std::vector<std::string> rowTitles;    ///< from row 1
};

/// What became known of a source after it was registered. No undo step of its own is wanted: use
/// History::amend.
struct UpdateDataset {
    std::string name;
    DatasetSource source;
};

/// Forgets a dataset and empties the cells that show it.
struct RemoveDataset {
    std::string name;
};

/// Cells that show it follow.
struct RenameDataset {
    std::string name;
    std::string newName;
};

/// Files moved: every path that begins with `from` (whole folder names) begins with `to` instead.
struct ReplacePathPrefix {
    std::string from;
    std::string to;
};

struct AddSheet {
    std::string name; ///< empty: the next free "SheetN"
};
struct RenameSheet {
    std::string name;
    std::string newName; ///< references in formulas follow
};
struct DeleteSheet {
    std::string name; ///< references to it become #REF!
};

struct ReplaceWorkbook {
    std::shared_ptr<const Workbook> workbook;
};

using Command =
    std::variant<SetStyle, SetSource, SetTitle, SetWorkbookTitle, SetLayout, SetLevels, InsertLines,
                 DeleteLines, ClearCells, MoveCells, SwapCells, AddDatasets, UpdateDataset, RemoveDataset,
                 RenameDataset, ReplacePathPrefix, AddSheet, RenameSheet, DeleteSheet, ReplaceWorkbook>;

/// The next snapshot (its version is that of `workbook`). Nothing changes when it throws: InvalidInput,
/// NotFound, Conflict or LimitExceeded. A SetStyle that would leave keys of an affected cell in disagreement
/// (requireConsistent) is InvalidInput.
[[nodiscard]] Workbook apply(const Workbook& workbook, const Command& command, const KeyTable& keys);

/// For the undo button: "Set camera.azimuth of cell B2".
[[nodiscard]] std::string commandLabel(const Command& command);

} // namespace voxsheet::sheet
