// Everything the page needs to know of a workbook, as JSON.
#pragma once

#include "engine/engine.h"

#include <nlohmann/json.hpp>

#include <string>

namespace voxsheet::http {

/// {KEY: {"value", "origin": "default|sheet|column|row|cell"}}
[[nodiscard]] nlohmann::json valuesJson(const sheet::ResolvedValues& values);

/// How much is said of each cell's style.
enum class StyleDetail {
    All, ///< every key of every cell, with where its value comes from
    Own  ///< sheets have "style", every key as their cells have it; cells only what column, row or cell set
};

/// {"name", "title", "rows", "columns", "columnTitles", "rowTitles", "cells": [{"cell", "title", "source",
/// "state", "code", "message", "progress", "dataset", "orientation", "box", "frame", "notes", "style"}]}:
/// every cell of a grid of up to 1024, only those with content of a larger one. "box" is the drawn box of
/// what the cell shows, also of a formula's result (engine::describeBox), of crystals with the "lattice" that
/// Miller indices refer to (rows a, b, c; engine::latticeOf), "frame" what the camera's lengths
/// refer to (engine::describeFrame); null while there is none.
[[nodiscard]] nlohmann::json sheetState(const engine::Engine& engine, const sheet::Workbook& workbook,
                                        const sheet::Sheet& sheet, StyleDetail detail = StyleDetail::All);

/// {"version", "canUndo", "canRedo", "workbook": document, "sheets": […]}
[[nodiscard]] nlohmann::json workbookState(const engine::Engine& engine,
                                           StyleDetail detail = StyleDetail::All);

/// One cell of sheetState, without its style. `status` may be null: the cell is empty. `style`: the cell's,
/// which says how many periods its box holds.
[[nodiscard]] nlohmann::json cellState(const sheet::Address& address, const sheet::Cell& cell,
                                       const engine::CellStatus* status, const sheet::TypedStyle& style);

} // namespace voxsheet::http
