// The sheet that anyone sees first.
#pragma once

#include <string>

namespace voxsheet::cli {

/// The workbook document (see sheet/workbook_json.h) over the files that writeDemo makes, with paths relative
/// to it.
[[nodiscard]] std::string demoWorkbookText();

} // namespace voxsheet::cli
