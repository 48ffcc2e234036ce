#include "cli/look_arguments.h"

#include "sheet/commands.h"
#include "sheet/plane_views.h"
#include "sheet/style_keys.h"
#include "sheet/style_presets.h"

#include <CLI/CLI.hpp>

namespace voxsheet::cli {

namespace {

void applyPreset(engine::Engine& engine, const std::string& sheetName, const std::string& name) {
    sheet::SetStyle edit;
    edit.sheet = sheetName;
    edit.clearNearer = true;
    edit.patch = sheet::presetNamed(engine.stylePresets(), name).style;
    engine.apply(edit);
}

/// `KEY=VALUE` for the whole sheet, `B2:KEY=VALUE` for one cell.
void applySetting(engine::Engine& engine, const std::string& sheetName, const std::string& text) {
    sheet::SetStyle edit;
    edit.sheet = sheetName;
    edit.clearNearer = true;
    std::string assignment = text;
    const auto colon = text.find(':');
    if (colon != std::string::npos && colon < text.find('=')) {
        edit.layer = sheet::Layer::ofCell(sheet::parseAddress(text.substr(0, colon)));
        assignment = text.substr(colon + 1);
    }
    edit.patch.insert(sheet::parseAssignment(engine.keys(), assignment));
    engine.apply(edit);
}

void addPlanes(engine::Engine& engine, const std::string& sheetName) {
    const auto workbook = engine.snapshot();
    const sheet::Sheet& sheet =
        sheetName.empty() ? workbook->sheets.front() : sheet::sheetNamed(*workbook, sheetName);
    std::vector<sheet::Address> cells;
    for (const auto& [address, cell] : sheet.cells)
        if (!cell.source.empty()) cells.push_back(address);
    if (cells.empty()) return;
    for (const auto& command : sheet::planesBeside(*workbook, engine.keys(), sheet.name, cells))
        engine.apply(command);
}

} // namespace

void addLookArguments(CLI::App& app, LookArguments& arguments) {
    app.add_option("--preset", arguments.preset,
                   "A named look for all cells, e.g. isosurface, half, cut-face, sphere");
    app.add_option("--set", arguments.settings,
                   "KEY=VALUE for all cells, or B2:KEY=VALUE for one; repeatable")
        ->take_all()
        ->allow_extra_args(false); // a file may follow
    app.add_flag("--planes", arguments.planes,
                 "Axial, coronal and sagittal planes to the right of every cell (below, where that is not "
                 "free), with one crosshair");
}

void applyLook(engine::Engine& engine, const std::string& sheetName, const LookArguments& arguments) {
    if (!arguments.preset.empty()) applyPreset(engine, sheetName, arguments.preset);
    for (const auto& setting : arguments.settings)
        applySetting(engine, sheetName, setting);
    if (arguments.planes) addPlanes(engine, sheetName);
}

} // namespace voxsheet::cli
