#include "base/errors.h"
#include "sheet/command_steps.h"
#include "sheet/layout.h"
#include "sheet/style_references.h"
#include "sheet/utf8.h"

#include <algorithm>
#include <set>

namespace voxsheet::sheet {

namespace {

DatasetSource& editDataset(Workbook& workbook, const std::string& name) {
    const auto found = workbook.datasets.find(name);
    if (found == workbook.datasets.end())
        throw NotFound("dataset " + inQuotes(name), "is not in the workbook", "see the list of datasets");
    return found->second;
}

void requireFreeName(const Workbook& workbook, const std::string& name) {
    validateDatasetName(name);
    if (workbook.datasets.contains(name))
        throw Conflict("dataset " + inQuotes(name), "is in the workbook already", "choose another name")
            .withField("name");
}

void prepareLayout(Sheet& sheet, const AddDatasets& command) {
    if (command.columns) {
        const Layout layout = layoutWithColumns(command.datasets.size(), *command.columns);
        sheet.columns = std::max(layout.columns, sheet.columns);
        sheet.autoLayout = false;
    }
    for (const NamedDataset& dataset : command.datasets) {
        if (!dataset.place) continue;
        const Address at = *dataset.place;
        if (at.column < 0 || at.row < 0 || at.column >= kMaxColumns || at.row >= kMaxRows)
            throw LimitExceeded("place of " + inQuotes(dataset.name), "is beyond what a sheet can have");
        sheet.columns = std::max(sheet.columns, at.column + 1);
        sheet.rows = std::max(sheet.rows, at.row + 1);
        sheet.autoLayout = false;
    }
}

void put(Sheet& sheet, const Address& at, const std::string& name) {
    Cell& cell = sheet.cells[at];
    if (!cell.source.empty())
        throw Conflict("cell " + addressName(at), "holds " + inQuotes(cell.source) + " already",
                       "choose another place for " + inQuotes(name));
    cell.source = name;
}

void place(Sheet& sheet, const AddDatasets& command) {
    prepareLayout(sheet, command);
    for (const NamedDataset& dataset : command.datasets)
        if (dataset.place) put(sheet, *dataset.place, dataset.name);
    const auto others = static_cast<std::size_t>(std::count_if(
        command.datasets.begin(), command.datasets.end(), [](const NamedDataset& d) { return !d.place; }));
    const FreeCells free = freeCells(sheet, others);
    if (others > 0) {
        sheet.columns = free.grown.columns;
        sheet.rows = free.grown.rows;
    }
    auto next = free.cells.begin();
    for (const NamedDataset& dataset : command.datasets)
        if (!dataset.place) put(sheet, *next++, dataset.name);
}

void setTitles(std::map<int, Header>& headers, const std::vector<std::string>& titles, int& count, int most) {
    if (titles.size() > static_cast<std::size_t>(most))
        throw LimitExceeded("titles", "are more than a sheet has columns or rows");
    count = std::max(count, static_cast<int>(titles.size()));
    for (std::size_t i = 0; i < titles.size(); ++i)
        if (!titles[i].empty()) headers[static_cast<int>(i)].title = titles[i];
}

/// Whole folder names only: "/data/run" is no prefix of "/data/run2/x".
bool beginsWithPath(const std::string& path, const std::string& prefix) {
    return path.starts_with(prefix) &&
           (path.size() == prefix.size() || prefix.ends_with('/') || path[prefix.size()] == '/');
}

} // namespace

void perform(Workbook& workbook, const AddDatasets& command) {
    for (const NamedDataset& dataset : command.datasets) {
        requireFreeName(workbook, dataset.name);
        workbook.datasets.emplace(dataset.name, dataset.source);
    }
    if (!command.place) return;
    Sheet& sheet = editSheet(workbook, command.sheet);
    place(sheet, command);
    setTitles(sheet.columnHeaders, command.columnTitles, sheet.columns, kMaxColumns);
    setTitles(sheet.rowHeaders, command.rowTitles, sheet.rows, kMaxRows);
}

void perform(Workbook& workbook, const UpdateDataset& command) {
    editDataset(workbook, command.name) = command.source;
}

void perform(Workbook& workbook, const RemoveDataset& command) {
    (void)editDataset(workbook, command.name);
    workbook.datasets.erase(command.name);
    for (Sheet& sheet : workbook.sheets) {
        for (auto& [address, cell] : sheet.cells)
            if (cell.source == command.name) cell.source.clear();
        std::erase_if(sheet.cells, [](const auto& entry) { return entry.second.isBlank(); });
    }
}

void perform(Workbook& workbook, const RenameDataset& command) {
    const DatasetSource source = editDataset(workbook, command.name);
    if (command.newName == command.name) return;
    requireFreeName(workbook, command.newName);
    workbook.datasets.erase(command.name);
    workbook.datasets.emplace(command.newName, source);
    for (Sheet& sheet : workbook.sheets) {
        for (auto& [address, cell] : sheet.cells)
            if (cell.source == command.name) cell.source = command.newName;
        forEachStyle(sheet,
                     [&](StyleMap& style) { renameDatasetInStyle(style, command.name, command.newName); });
    }
}

void perform(Workbook& workbook, const ReplacePathPrefix& command) {
    if (command.from.empty())
        throw InvalidInput("path prefix", "is empty", "give the part to replace").withField("from");
    bool any = false;
    for (auto& [name, source] : workbook.datasets) {
        for (std::string& file : source.files) {
            if (!beginsWithPath(file, command.from)) continue;
            file = command.to + file.substr(command.from.size());
            any = true;
        }
    }
    if (!any)
        throw NotFound("path prefix " + inQuotes(command.from), "begins no file of the workbook",
                       "see the files of its datasets")
            .withField("from");
}

} // namespace voxsheet::sheet
