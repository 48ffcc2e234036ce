// The workbook as a document:
//
//   {"voxsheet": 1, "title": "…",
//    "datasets": {"run1": {"files": ["run1/CHGCAR"], "bytes": 123, "checksum": "xxh3:…", "options": {}}},
//    "sheets": [{"name": "Sheet1", "title": "…", "columns": 3, "rows": 2, "style": {…},
//                "levels": {"policy": "slope", …} (level_settings_json.h),
//                "columnHeaders": {"A": {"title": "…", "style": {…}}}, "rowHeaders": {"1": {…}},
//                "cells": {"A1": {"source": "run1", "title": "…", "style": {…}}, "B1": {"source":
//                "=B1-A1"}}}]}
//
// Members that hold nothing are left out; all but "voxsheet" and "sheets" are optional. Unknown members are
// errors: a misspelt one must not be lost in silence.
#pragma once

#include "sheet/style_keys.h"
#include "sheet/workbook.h"

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

inline constexpr int kWorkbookFormat = 1;

[[nodiscard]] nlohmann::ordered_json workbookToJson(const Workbook& workbook);
[[nodiscard]] nlohmann::ordered_json sheetToJson(const Sheet& sheet);
[[nodiscard]] nlohmann::ordered_json cellToJson(const Cell& cell);

/// Throws InvalidInput whose field() is the member's path, e.g. `sheets[0].cells.B2.style.camera.fov`;
/// Unsupported for a newer format.
[[nodiscard]] Workbook workbookFromJson(const nlohmann::json& document, const KeyTable& keys);

/// As a file: two blanks of indentation, a line feed at the end; equal workbooks give equal bytes.
[[nodiscard]] std::string serialiseWorkbook(const Workbook& workbook);
/// Inverse of serialiseWorkbook, for text from anywhere. Throws as parseBoundedJson and workbookFromJson.
[[nodiscard]] Workbook parseWorkbook(std::string_view text, const KeyTable& keys);

} // namespace voxsheet::sheet
