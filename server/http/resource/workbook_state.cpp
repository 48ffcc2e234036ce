#include "http/resource/workbook_state.h"

#include "engine/cell_resolver.h"
#include "engine/dataset_json.h"
#include "engine/lattice_planes.h"
#include "http/resource/edit_answer.h"
#include "sheet/workbook_json.h"

#include <map>

namespace voxsheet::http {

namespace {

constexpr int kMaxListedCells = 1024; ///< above it blank cells are left out

const char* stateWord(engine::CellState state) {
    switch (state) {
    case engine::CellState::Empty:
        return "empty";
    case engine::CellState::Pending:
        return "importing";
    case engine::CellState::Ready:
        return "ok";
    case engine::CellState::Error:
        break;
    }
    return "error";
}

nlohmann::json sourceJson(const sheet::Cell& cell) {
    if (cell.isFormula()) return {{"formula", cell.source}};
    if (cell.isDataset()) return {{"dataset", cell.source}};
    return nullptr;
}

nlohmann::json titlesJson(const std::map<int, sheet::Header>& headers, std::string (*name)(int)) {
    auto titles = nlohmann::json::object();
    for (const auto& [line, header] : headers)
        if (!header.title.empty()) titles[name(line)] = header.title;
    return titles;
}

sheet::ResolvedValues setBelowTheSheet(const sheet::ResolvedValues& values) {
    sheet::ResolvedValues own;
    for (const auto& [key, resolved] : values) {
        const auto kind = resolved.origin.kind;
        if (kind == sheet::LayerKind::Column || kind == sheet::LayerKind::Row ||
            kind == sheet::LayerKind::Cell)
            own.emplace(key, resolved);
    }
    return own;
}

} // namespace

nlohmann::json valuesJson(const sheet::ResolvedValues& values) {
    auto out = nlohmann::json::object();
    for (const auto& [key, resolved] : values)
        out[key] = {{"value", sheet::styleValueToJson(resolved.value)},
                    {"origin", layerWord(resolved.origin.kind)}};
    return out;
}

nlohmann::json cellState(const sheet::Address& address, const sheet::Cell& cell,
                         const engine::CellStatus* status, const sheet::TypedStyle& style) {
    const auto state = status != nullptr ? status->state : engine::CellState::Empty;
    const bool ready = state == engine::CellState::Ready && status->meta != nullptr;
    nlohmann::json out{{"cell", sheet::addressName(address)},
                       {"title", sheet::cellTitle(cell)},
                       {"source", sourceJson(cell)},
                       {"state", stateWord(state)},
                       {"dataset", nullptr},
                       {"orientation", ready && status->meta->anatomical}};
    out["box"] = nullptr;
    if (ready) {
        const auto window = engine::periodicWindow(style.periodic);
        out["box"] = engine::describeBox(drawnGrid(status->meta->grid, window));
        if (const auto lattice = engine::latticeOf(*status->meta))
            out["box"]["lattice"] = engine::describeLattice(*lattice);
    }
    out["frame"] = nullptr;
    if (ready && status->frame) out["frame"] = engine::describeFrame(*status->frame);
    if (cell.isDataset()) out["dataset"] = cell.source;
    if (status == nullptr) return out;
    out["code"] = status->code;
    out["message"] = status->message;
    out["progress"] = status->progress;
    out["notes"] = status->notes;
    return out;
}

nlohmann::json sheetState(const engine::Engine& engine, const sheet::Workbook& workbook,
                          const sheet::Sheet& sheet, StyleDetail detail) {
    std::map<sheet::Address, engine::CellStatus> statuses;
    for (auto& status : engine.cellStatuses(workbook, sheet.name))
        statuses[status.cell] = std::move(status);
    auto cells = nlohmann::json::array();
    const bool all = sheet.columns * sheet.rows <= kMaxListedCells;
    const sheet::Cell blank;
    for (int row = 0; row < sheet.rows; ++row)
        for (int column = 0; column < sheet.columns; ++column) {
            const sheet::Address address{column, row};
            const auto* cell = sheet.find(address);
            if (cell == nullptr && !all) continue;
            const auto status = statuses.find(address);
            const auto resolved = sheet::resolveStyle(engine.keys(), sheet, address);
            auto entry = cellState(address, cell != nullptr ? *cell : blank,
                                   status != statuses.end() ? &status->second : nullptr, resolved.style);
            entry["style"] =
                valuesJson(detail == StyleDetail::All ? resolved.values : setBelowTheSheet(resolved.values));
            cells.push_back(std::move(entry));
        }
    nlohmann::json out{{"name", sheet.name},
                       {"title", sheet.title},
                       {"rows", sheet.rows},
                       {"columns", sheet.columns},
                       {"columnTitles", titlesJson(sheet.columnHeaders, &sheet::columnName)},
                       {"rowTitles", titlesJson(sheet.rowHeaders, &sheet::rowName)},
                       {"cells", std::move(cells)}};
    if (detail == StyleDetail::Own)
        out["style"] = valuesJson(sheet::resolveLayer(engine.keys(), sheet, sheet::Layer::sheet()));
    return out;
}

nlohmann::json workbookState(const engine::Engine& engine, StyleDetail detail) {
    const auto workbook = engine.snapshot();
    auto sheets = nlohmann::json::array();
    for (const auto& sheet : workbook->sheets)
        sheets.push_back(sheetState(engine, *workbook, sheet, detail));
    return {{"version", workbook->version},
            {"canUndo", engine.canUndo()},
            {"canRedo", engine.canRedo()},
            {"workbook", sheet::workbookToJson(*workbook)},
            {"sheets", std::move(sheets)}};
}

} // namespace voxsheet::http
