// The options of an import as JSON: in the HTTP API, in the workbook and on the importer's command line.
#pragma once

#include "import/source_reader.h"

#include <nlohmann/json.hpp>

#include <string>

namespace voxsheet::import {

/// An object with any of these members; null counts as absent:
///   "dims" [x, y, z] of samples, "type" "u8" … "f64", "endian" "little" | "big", "skip_bytes", "components":
///   for files
///     without a header
///   "spacing" [x, y, z] > 0, "origin" [x, y, z]: world units
///   "orientation" "LPI": to which sides of a patient the index axes x, y and z lead
///   "flip" [x, y, z] of booleans: mirrors along an index axis
///   "periodic" boolean, or [x, y, z] of booleans
///   "bit_mask" whole number above 0, or its text ("0x7fff"): the bits of whole numbers that are values
///   "no_data" number: becomes NaN
///   "resolution" 16 … 256: samples along the longest axis of the volume made from a surface (STL, PLY, OBJ)
///   "divide_by_cell_volume" boolean: CHGCAR family
///   "series" "stack" | "steps": what several files make together
/// Throws InvalidInput, with the member as field, for unknown members, wrong types and values out of range.
[[nodiscard]] ImportOptions importOptionsFromJson(const nlohmann::json& json);

/// Canonical text: equal options give equal text, options that are not set do not appear. Part of the store's
/// key.
[[nodiscard]] std::string canonicalOptions(const ImportOptions& options);

} // namespace voxsheet::import
