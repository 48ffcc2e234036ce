// Options that say how cells look: a preset, and single style values. Shared by serve and render.
#pragma once

#include "engine/engine.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace voxsheet::cli {

struct LookArguments {
    std::string preset;
    std::vector<std::string> settings; ///< KEY=VALUE, or B2:KEY=VALUE
    bool planes = false;               ///< planesBeside() every cell
};

void addLookArguments(CLI::App& app, LookArguments& arguments);

/// The preset for the whole sheet, then the settings in their order, then the planes; each over whatever
/// columns, rows and cells say. Throws NotFound (no such preset, with the nearest name) and InvalidInput
/// (key, value or cell).
void applyLook(engine::Engine& engine, const std::string& sheetName, const LookArguments& arguments);

} // namespace voxsheet::cli
