// How levels of detail are chosen, as a JSON object of the workbook and of the API:
//
//   {"policy": "focus", "frame_ms": 1000.0, "frames_per_second": 1.0, "datasets": 25, "bytes": 1073741824,
//    "up_fraction": 0.8}
#pragma once

#include "resolution/level_settings.h"
#include "sheet/json_reader.h"

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

/// Every member.
[[nodiscard]] nlohmann::ordered_json levelSettingsToJson(const LevelSettings& settings);
/// Members that are left out keep their value in `base`. Throws InvalidInput (field = the member's path) for
/// an unknown member, a wrong type, or a value out of its range.
[[nodiscard]] LevelSettings levelSettingsFromJson(const JsonReader& object, const LevelSettings& base = {});

} // namespace voxsheet::sheet
