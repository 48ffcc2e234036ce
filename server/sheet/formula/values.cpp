#include "sheet/formula/values.h"

#include "sheet/formula/dependency_graph.h"
#include "sheet/formula/formula_compiler.h"
#include "sheet/formula/parser.h"
#include "sheet/utf8.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

struct FormulaCell {
    CellPosition position;
    std::variant<FormulaAst, CellError> parsed;
};

/// Computes the values of one snapshot.
class Evaluation {
public:
    Evaluation(const KeyTable& keys, const Workbook& workbook, const DatasetLookup& lookup)
        : keys_(keys), workbook_(workbook), lookup_(lookup) {
        for (std::size_t i = 0; i < workbook.sheets.size(); ++i)
            sheets_[lowerAscii(workbook.sheets[i].name)] = i;
    }

    WorkbookValues run() {
        collect();
        for (const std::vector<int>& component : componentsInOrder(graph_)) {
            const auto first = static_cast<std::size_t>(component.front());
            const auto& needs = graph_[first];
            const bool cyclic = component.size() > 1 ||
                                std::find(needs.begin(), needs.end(), component.front()) != needs.end();
            if (cyclic)
                refuseCycle(component);
            else
                compute(formulas_[first]);
        }
        return std::move(values_);
    }

private:
    void collect() {
        for (std::size_t s = 0; s < workbook_.sheets.size(); ++s) {
            for (const auto& [address, cell] : workbook_.sheets[s].cells) {
                const CellPosition position{s, address};
                if (cell.isDataset()) values_.cells[position] = datasetValue(cell.source);
                if (!cell.isFormula()) continue;
                indices_[position] = static_cast<int>(formulas_.size());
                formulas_.push_back({position, parseFormula(cell.source)});
            }
        }
        graph_.resize(formulas_.size());
        for (std::size_t i = 0; i < formulas_.size(); ++i) {
            const auto* ast = std::get_if<FormulaAst>(&formulas_[i].parsed);
            if (!ast) continue;
            for (const FormulaNode& node : ast->nodes) {
                if (node.kind != NodeKind::Reference) continue;
                const auto target = locate(node, formulas_[i].position.sheet);
                const auto found = target ? indices_.find(*target) : indices_.end();
                if (found != indices_.end()) graph_[i].push_back(found->second);
            }
        }
    }

    /// nullopt if the sheet does not exist.
    std::optional<CellPosition> locate(const FormulaNode& node, std::size_t ownSheet) const {
        if (node.name.empty()) return CellPosition{ownSheet, node.range.first};
        const auto found = sheets_.find(lowerAscii(node.name));
        if (found == sheets_.end()) return std::nullopt;
        return CellPosition{found->second, node.range.first};
    }

    CellValue datasetValue(const std::string& name) {
        if (!workbook_.datasets.contains(name))
            return CellError{CellErrorCode::Ref, "The dataset " + inQuotes(name) +
                                                     " is not in the workbook; add it again or "
                                                     "choose another one."};
        auto state = states_.find(name);
        if (state == states_.end()) state = states_.emplace(name, lookup_(name)).first;
        if (const auto* failed = std::get_if<DatasetFailed>(&state->second))
            return CellError{CellErrorCode::Import, failed->sentence};
        if (const auto* ready = std::get_if<DatasetReady>(&state->second))
            return DatasetValue{name, ready->grid};
        return PendingValue{name};
    }

    void refuseCycle(const std::vector<int>& component) {
        std::string path;
        const std::vector<int> cycle = shortestCycle(graph_, component.front());
        constexpr std::size_t longest = 8;
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            if (cycle.size() > longest && i == longest - 1) path += " → …";
            if (cycle.size() > longest && i >= longest - 1 && i + 1 < cycle.size()) continue;
            path += (i == 0 ? "" : " → ") + name(formulas_[static_cast<std::size_t>(cycle[i])].position);
        }
        for (const int index : component) {
            const CellPosition& position = formulas_[static_cast<std::size_t>(index)].position;
            values_.cells[position] = CellError{CellErrorCode::Cycle, "The formulas go in a circle: " + path +
                                                                          "; change one of them."};
            roots_[position] = position;
            values_.order.push_back(position);
        }
    }

    void compute(const FormulaCell& formula) {
        values_.order.push_back(formula.position);
        if (const auto* error = std::get_if<CellError>(&formula.parsed)) {
            values_.cells[formula.position] = *error;
            return;
        }
        const auto resolve = [&](const FormulaNode& node) { return operand(node, formula.position); };
        values_.cells[formula.position] =
            compileFormula(std::get<FormulaAst>(formula.parsed), resolve, copiesLeft_);
    }

    /// What a reference stands for, or the error that the formula gets because of it.
    FormulaOperand operand(const FormulaNode& node, const CellPosition& user) {
        const std::string shown = addressName(SheetAddress{node.name, node.range.first});
        const auto target = locate(node, user.sheet);
        if (!target)
            return {shown, CellError{CellErrorCode::Ref,
                                     "There is no sheet " + inQuotes(node.name) + "; correct its name."}};
        const Sheet& sheet = workbook_.sheets[target->sheet];
        if (!sheet.contains(target->cell))
            return {shown, CellError{CellErrorCode::Ref, shown + " is outside the sheet, which has " +
                                                             std::to_string(sheet.columns) + " columns and " +
                                                             std::to_string(sheet.rows) +
                                                             " rows; choose a cell inside it."}};
        const auto found = values_.cells.find(*target);
        if (found == values_.cells.end())
            return {shown, CellError{CellErrorCode::Ref,
                                     shown + " is empty; put a dataset there or choose another cell."}};
        if (const auto* error = std::get_if<CellError>(&found->second))
            return {shown, inherited(*error, *target, user)};
        FormulaOperand result{shown, found->second};
        if (std::holds_alternative<DatasetValue>(found->second)) {
            const TypedStyle style = resolveStyle(keys_, sheet, target->cell).style;
            result.field = style.field;
            result.timeStep = style.timeStep;
        }
        return result;
    }

    /// The same code; the sentence names the cell where it began, however long the chain.
    CellError inherited(const CellError& error, const CellPosition& target, const CellPosition& user) {
        const auto known = roots_.find(target);
        const CellPosition root = known == roots_.end() ? target : known->second;
        roots_[user] = root;
        const auto& rootError = std::get<CellError>(values_.cells.at(root));
        return {error.code, "It uses " + name(root) + ", which is " + cellErrorCodeName(error.code) + " " +
                                rootError.sentence};
    }

    std::string name(const CellPosition& position) const {
        const bool several = workbook_.sheets.size() > 1;
        return addressName(SheetAddress{several ? workbook_.sheets[position.sheet].name : "", position.cell});
    }

    const KeyTable& keys_;
    const Workbook& workbook_;
    const DatasetLookup& lookup_;
    std::map<std::string, std::size_t> sheets_;
    std::map<std::string, DatasetState> states_;
    std::vector<FormulaCell> formulas_;
    std::map<CellPosition, int> indices_;
    DependencyGraph graph_;
    std::map<CellPosition, CellPosition> roots_; ///< of errors that came from elsewhere
    std::size_t copiesLeft_ = kMaxCopiedSteps;
    WorkbookValues values_;
};

} // namespace

WorkbookValues evaluateWorkbook(const KeyTable& keys, const Workbook& workbook, const DatasetLookup& lookup) {
    return Evaluation(keys, workbook, lookup).run();
}

const CellValue& valueAt(const WorkbookValues& values, const CellPosition& position) {
    static const CellValue empty{EmptyValue{}};
    const auto found = values.cells.find(position);
    return found == values.cells.end() ? empty : found->second;
}

} // namespace voxsheet::sheet
