#include "sheet/commands.h"

#include "base/errors.h"
#include "sheet/command_steps.h"
#include "sheet/formula/references.h"
#include "sheet/style_references.h"
#include "sheet/utf8.h"

#include <type_traits>

namespace voxsheet::sheet {

namespace {

struct Labeller {
    static std::string several(std::size_t count, const std::string& one) {
        return count == 1 ? one : std::to_string(count) + " " + one + "s";
    }

    std::string operator()(const SetStyle& c) const {
        if (c.patch.size() == 1) {
            const auto& [key, value] = *c.patch.begin();
            return (value ? "Set " : "Reset ") + key + " of " + layerName(c.layer);
        }
        return "Set " + std::to_string(c.patch.size()) + " values of " + layerName(c.layer);
    }
    std::string operator()(const SetSource& c) const {
        return (c.source.empty() ? "Empty cell " : "Fill cell ") + addressName(c.cell);
    }
    std::string operator()(const SetTitle& c) const { return "Title of " + layerName(c.layer); }
    std::string operator()(const SetWorkbookTitle&) const { return "Title of the workbook"; }
    std::string operator()(const SetLayout& c) const {
        return "Arrange in " + std::to_string(c.columns) + (c.columns == 1 ? " column" : " columns");
    }
    std::string operator()(const SetLevels& c) const {
        return "Levels of detail: " +
               std::string(c.levels ? levelPolicyName(c.levels->policy) : "as the server was started");
    }
    std::string operator()(const InsertLines& c) const {
        return "Insert " +
               several(static_cast<std::size_t>(c.count), c.axis == Axis::Columns ? "column" : "row");
    }
    std::string operator()(const DeleteLines& c) const {
        return "Delete " +
               several(static_cast<std::size_t>(c.count), c.axis == Axis::Columns ? "column" : "row");
    }
    std::string operator()(const ClearCells& c) const { return "Clear " + rangeName(c.range); }
    std::string operator()(const MoveCells& c) const {
        return "Move " + rangeName(c.from) + " to " + addressName(c.to);
    }
    std::string operator()(const SwapCells& c) const {
        return "Swap " + addressName(c.first) + " and " + addressName(c.second);
    }
    std::string operator()(const AddDatasets& c) const {
        return "Add " +
               (c.datasets.size() == 1 ? c.datasets.front().name : several(c.datasets.size(), "dataset"));
    }
    std::string operator()(const UpdateDataset& c) const { return "Update " + c.name; }
    std::string operator()(const RemoveDataset& c) const { return "Remove " + c.name; }
    std::string operator()(const RenameDataset& c) const { return "Rename " + c.name; }
    std::string operator()(const ReplacePathPrefix&) const { return "Replace path prefix"; }
    std::string operator()(const AddSheet&) const { return "Add sheet"; }
    std::string operator()(const RenameSheet& c) const { return "Rename sheet " + c.name; }
    std::string operator()(const DeleteSheet& c) const { return "Delete sheet " + c.name; }
    std::string operator()(const ReplaceWorkbook&) const { return "Replace the workbook"; }
};

} // namespace

Workbook apply(const Workbook& workbook, const Command& command, const KeyTable& keys) {
    Workbook next = workbook;
    std::visit(
        [&](const auto& c) {
            using C = std::decay_t<decltype(c)>;
            if constexpr (std::is_same_v<C, SetStyle>) {
                perform(next, c, keys); // checks the values itself; a drag makes many of these
            } else {
                perform(next, c);
                validateWorkbook(next);
            }
        },
        command);
    next.version = workbook.version;
    return next;
}

std::string commandLabel(const Command& command) { return std::visit(Labeller{}, command); }

Sheet& editSheet(Workbook& workbook, const std::string& name) {
    return workbook.sheets[sheetIndex(workbook, name)];
}

void requireLayer(const Sheet& sheet, const Layer& layer) { (void)ownStyle(sheet, layer); }

void dropIfBlank(Sheet& sheet, const Address& address) {
    const auto found = sheet.cells.find(address);
    if (found != sheet.cells.end() && found->second.isBlank()) sheet.cells.erase(found);
}

void moveReferences(Workbook& workbook, const std::string& sheet, const CellsMove& move) {
    const std::string target = lowerAscii(sheet);
    for (Sheet& each : workbook.sheets) {
        const bool own = lowerAscii(each.name) == target;
        const ReferenceMove moved = [&](const std::string& named,
                                        const AddressRange& range) -> std::optional<AddressRange> {
            const bool concerns = named.empty() ? own : lowerAscii(named) == target;
            return concerns ? move(range) : range;
        };
        for (auto& [address, cell] : each.cells)
            if (cell.isFormula()) cell.source = rewriteReferences(cell.source, moved);
        forEachStyle(each, [&](StyleMap& style) { moveStyleReferences(style, moved); });
    }
}

} // namespace voxsheet::sheet
