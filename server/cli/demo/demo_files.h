// `voxsheet demo DIR`: the demo's datasets as files, and the workbook that shows them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::cli {

struct DemoReport {
    std::vector<std::filesystem::path> written;   ///< new or different from what was there
    std::vector<std::filesystem::path> unchanged; ///< left alone, with their time stamps
    std::filesystem::path workbook;
    std::filesystem::path keptWorkbook; ///< an edited demo.json that was there, moved aside; empty if none
};

/// Deterministic: the same bytes on every run. A file that already has these bytes is not touched; a workbook
/// that was edited is kept as demo-edited-N.json. Throws IoError if the folder cannot be written.
DemoReport writeDemo(const std::filesystem::path& folder);

} // namespace voxsheet::cli
