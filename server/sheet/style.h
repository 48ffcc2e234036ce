// Inheritance: sheet -> column -> row -> cell, key by key; the nearer value wins.
#pragma once

#include "sheet/address.h"
#include "sheet/style_keys.h"
#include "sheet/typed_style.h"
#include "sheet/workbook.h"

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

/// From far to near: a later one wins.
enum class LayerKind {
    Default,  ///< the key table
    Sheet,    ///< the workbook's sheet
    PageView, ///< what one page looks at, for all linked cells (not in the workbook)
    Column,
    Row,
    Cell,
    PageCell, ///< what one page looks at in one cell (not in the workbook)
    Request,  ///< the query of one image request, or `--set`
};

struct Layer {
    LayerKind kind = LayerKind::Sheet;
    int column = 0; ///< Column, Cell, PageCell
    int row = 0;    ///< Row, Cell, PageCell

    bool operator==(const Layer&) const = default;
    [[nodiscard]] static Layer sheet() { return {}; }
    [[nodiscard]] static Layer ofColumn(int column) { return {LayerKind::Column, column, 0}; }
    [[nodiscard]] static Layer ofRow(int row) { return {LayerKind::Row, 0, row}; }
    [[nodiscard]] static Layer ofCell(const Address& a) { return {LayerKind::Cell, a.column, a.row}; }
};

/// "default", "sheet", "column B", "row 2", "cell B2", "view", "view of B2", "request".
[[nodiscard]] std::string layerName(const Layer& layer);

/// Values that are not in the workbook: the view of one page, or the query of one request.
struct StyleOverlay {
    StyleMap view;                     ///< LayerKind::PageView
    std::map<Address, StyleMap> cells; ///< LayerKind::PageCell
    StyleMap request;                  ///< LayerKind::Request
};

struct ResolvedValue {
    StyleValue value;
    Layer origin;
};

/// Every key of the table.
using ResolvedValues = std::map<std::string, ResolvedValue>;

struct ResolvedStyle {
    TypedStyle style;
    ResolvedValues values;
};

/// The style of a cell, whether it has content or not. Throws NotFound if the address is outside the sheet.
/// The keys' agreement is not checked: see requireConsistent.
[[nodiscard]] ResolvedStyle resolveStyle(const KeyTable& keys, const Sheet& sheet, const Address& address,
                                         const StyleOverlay& overlay = {});

/// Every key at its default.
[[nodiscard]] ResolvedStyle defaultStyle(const KeyTable& keys);

/// Only the values and origins that reach a layer itself: a sheet sees defaults and its own; a column or row
/// also the sheet's; a cell all.
[[nodiscard]] ResolvedValues resolveLayer(const KeyTable& keys, const Sheet& sheet, const Layer& layer);

/// What a layer of the workbook sets itself; empty if nothing. Throws NotFound if it is outside the sheet.
[[nodiscard]] const StyleMap& ownStyle(const Sheet& sheet, const Layer& layer);

/// A value nearer to some cells that hides an edit of `edited`.
struct HiddenBy {
    std::string key;
    Layer nearer;
    std::vector<Address> cells; ///< the cells (with content, or the one edited) where it hides the edit
};

/// Which nearer values hide these keys of a layer from some of its cells. Empty: the edit shows everywhere.
[[nodiscard]] std::vector<HiddenBy> hiddenBy(const Sheet& sheet, const Layer& edited,
                                             const std::vector<std::string>& keys);

/// One sentence for the page: "camera.azimuth is set nearer by cell B2, row 3".
[[nodiscard]] std::string hiddenSentence(const std::vector<HiddenBy>& hidden);

/// Every value that some column, row or cell sets: what the page marks as overrides.
struct Override {
    Layer layer;
    std::string key;
    StyleValue value;
};
[[nodiscard]] std::vector<Override> listOverrides(const Sheet& sheet);

/// {"KEY": {"value": …, "origin": "column B", "own": bool}, …}; own: set by `layer` itself.
[[nodiscard]] nlohmann::json resolvedToJson(const ResolvedValues& values, const Layer& layer);

/// The typed struct from values of every key. Throws InternalError if a key is absent.
[[nodiscard]] TypedStyle typedStyle(const ResolvedValues& values);

} // namespace voxsheet::sheet
