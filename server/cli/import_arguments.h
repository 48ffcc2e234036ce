// Options that say how data files are to be read. Shared by serve, render and info.
#pragma once

#include "sheet/workbook.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace voxsheet::cli {

struct ImportArguments {
    std::vector<std::string> settings; ///< [PATTERN:]KEY=VALUE in the order in which they were given
};

/// --import, and a short form of each of its keys: --dims, --type, --endian, --skip-bytes, --components,
/// --spacing,
/// --origin, --flip, --periodic, --no-data.
void addImportArguments(CLI::App& app, ImportArguments& arguments);

/// What holds for one file, as in import_options_json.h; a later setting wins. A pattern is compared with the
/// file's name and with its path, as a shell does. Throws InvalidInput (field "--KEY") for unknown keys and
/// wrong values.
[[nodiscard]] nlohmann::json importOptionsFor(const ImportArguments& arguments, const std::string& file);

/// Gives every dataset the options of its first file. Throws as importOptionsFor; InvalidInput if a pattern
/// fits no file.
void setImportOptions(sheet::Workbook& workbook, const ImportArguments& arguments);

} // namespace voxsheet::cli
