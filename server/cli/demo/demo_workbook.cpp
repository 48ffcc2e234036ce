#include "cli/demo/demo_workbook.h"

#include "sheet/address.h"
#include "sheet/workbook.h"
#include "sheet/workbook_json.h"

#include <array>
#include <string>

namespace voxsheet::cli {

namespace {

using sheet::Address;

void addDataset(sheet::Workbook& workbook, const Address& cell, const std::string& name,
                const std::string& file, const std::string& title) {
    workbook.datasets[name].files = {file};
    auto& target = workbook.sheets.front().cells[cell];
    target.source = name;
    target.title = title;
}

/// Row 1: densities; the row's fixed range shows bonds and shells instead of the cores' sharp peaks.
void addDensities(sheet::Workbook& workbook) {
    auto& rows = workbook.sheets.front().rowHeaders;
    addDataset(workbook, {0, 0}, "perfect", "perfect_CHGCAR", "perfect crystal");
    addDataset(workbook, {1, 0}, "vacancy Mg", "vacancy_Mg_CHGCAR", "Mg vacancy");
    addDataset(workbook, {2, 0}, "vacancy Si", "vacancy_Si_CHGCAR", "Si vacancy");
    addDataset(workbook, {3, 0}, "vacancy O", "vacancy_O_CHGCAR", "O vacancy");
    rows[0].title = "electron density, MgSiO3 perovskite";
    rows[0].style = {
        {"range.mode", std::string("fixed")},
        {"range.min", 0.0},
        {"range.max", 6.0},
        {"transfer.map", std::string("inferno")},
        {"transfer.opacity",
         sheet::OpacityStops{{0.0, 0.0}, {0.05, 0.0}, {0.12, 0.02}, {0.3, 0.05}, {1.0, 0.5}}},
    };
}

/// Row 2: what each vacancy changed, as formulas, and a cell with a look of its own.
void addDifferences(sheet::Workbook& workbook) {
    auto& page = workbook.sheets.front();
    const std::array<const char*, 3> formulas{"=B1-A1", "=C1-A1", "=D1-A1"};
    const std::array<const char*, 3> titles{"Mg vacancy - perfect", "Si vacancy - perfect",
                                            "O vacancy - perfect"};
    for (int i = 0; i < 3; ++i) {
        auto& cell = page.cells[{i + 1, 1}];
        cell.source = formulas[static_cast<std::size_t>(i)];
        cell.title = titles[static_cast<std::size_t>(i)];
    }
    page.rowHeaders[1].title = "induced by the vacancy";
    page.rowHeaders[1].style = {
        {"range.mode", std::string("fixed")},
        {"range.min", -2.0},
        {"range.max", 2.0},
        {"transfer.map", std::string("cool-warm")},
        {"transfer.opacity",
         sheet::OpacityStops{{0.0, 0.4}, {0.4, 0.08}, {0.48, 0.0}, {0.52, 0.0}, {0.6, 0.08}, {1.0, 0.4}}},
    };
    addDataset(workbook, {0, 1}, "Marschner-Lobb", "marschner_lobb.nrrd", "Marschner-Lobb test signal");
    page.cells[{0, 1}].style = {
        {"range.mode", std::string("own")},
        {"range.min", sheet::None{}},
        {"range.max", sheet::None{}},
        {"transfer.map", std::string("viridis")},
        {"transfer.opacity",
         sheet::OpacityStops{{0.0, 0.0}, {0.46, 0.0}, {0.5, 0.6}, {0.54, 0.0}, {1.0, 0.0}}},
    };
}

/// Row 3: three steps of one beat, one per cell, and their change.
void addTimeSteps(sheet::Workbook& workbook) {
    auto& page = workbook.sheets.front();
    const std::array<const char*, 3> titles{"t = 0", "t = T/4", "t = T/2"};
    for (int step = 0; step < 3; ++step)
        addDataset(workbook, {step, 2}, "beat " + std::to_string(step),
                   "hydrogen_beat_" + std::to_string(step) + ".nrrd", titles[static_cast<std::size_t>(step)]);
    page.rowHeaders[2].title = "hydrogen, 1s + 2p beat, T = 0.405 fs";
    page.rowHeaders[2].style = {
        {"range.mode", std::string("fixed")},
        {"range.min", 0.0},
        {"range.max", 0.004},
        {"transfer.map", std::string("viridis")},
        {"transfer.opacity",
         sheet::OpacityStops{{0.0, 0.0}, {0.04, 0.0}, {0.12, 0.02}, {0.4, 0.05}, {0.9, 0.1}, {1.0, 0.3}}},
    };
    auto& change = page.cells[{3, 2}];
    change.source = "=C3-A3";
    change.title = "change over half a beat";
    change.style = {
        {"range.min", -0.004},
        {"transfer.map", std::string("cool-warm")},
        {"transfer.opacity",
         sheet::OpacityStops{{0.0, 0.3}, {0.4, 0.05}, {0.48, 0.0}, {0.52, 0.0}, {0.6, 0.05}, {1.0, 0.3}}},
    };
}

} // namespace

std::string demoWorkbookText() {
    sheet::Workbook workbook;
    workbook.title = "Voxsheet demo: vacancies in MgSiO3 perovskite";
    auto& page = workbook.sheets.front();
    page.name = "Demo";
    page.columns = 4;
    page.rows = 3;
    page.style = {{"camera.azimuth", 155.0}, {"camera.elevation", 22.0}, {"camera.distance", 3.7}};
    addDensities(workbook);
    addDifferences(workbook);
    addTimeSteps(workbook);
    return sheet::serialiseWorkbook(workbook);
}

} // namespace voxsheet::cli
