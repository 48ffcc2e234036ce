#include "sheet/formula/formula_compiler.h"

#include "sheet/formula/functions.h"
#include "sheet/formula/plan_builder.h"
#include "sheet/near_miss.h"
#include "sheet/utf8.h"

#include <algorithm>
#include <map>

namespace voxsheet::sheet {

namespace {

/// Thrown and caught in this file only.
struct CompileFailure {
    CellError error;
};

[[noreturn]] void fail(CellErrorCode code, std::string sentence) {
    throw CompileFailure{{code, std::move(sentence)}};
}

std::string shapeText(const glm::ivec3& dims) {
    return std::to_string(dims.x) + " x " + std::to_string(dims.y) + " x " + std::to_string(dims.z);
}

/// Largest distance between the corner samples of two grids of equal dims, in voxel edges of the first.
double displacementVoxels(const Grid& a, const Grid& b) {
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 index((corner & 1) ? a.dims.x - 1 : 0, (corner & 2) ? a.dims.y - 1 : 0,
                               (corner & 4) ? a.dims.z - 1 : 0, 1.0);
        largest = std::max(largest, glm::length(glm::dvec3((a.worldFromIndex - b.worldFromIndex) * index)));
    }
    return largest / meanVoxelEdgeWorld(a);
}

class Compiler {
public:
    Compiler(const FormulaAst& ast, const std::function<FormulaOperand(const FormulaNode&)>& resolve,
             std::size_t& copiesLeft)
        : ast_(ast), resolve_(resolve), copiesLeft_(copiesLeft) {}

    CellValue run() {
        for (const FormulaNode& node : ast_.nodes) {
            steps_.push_back(compile(node));
            if (builder_.isTooLarge()) tooLarge();
        }
        if (!pending_.empty()) return PendingValue{pending_};
        if (!grid_)
            fail(CellErrorCode::Type,
                 "The result is a number, not a volume; use at least one cell that holds a volume.");
        return FormulaValue{builder_.finish(steps_.back()), *grid_, std::move(notes_)};
    }

private:
    [[noreturn]] static void tooLarge() {
        fail(CellErrorCode::Mem,
             "The formula has too many steps or inputs once the formulas that it uses are written out; "
             "split the work over datasets.");
    }
    int child(const FormulaNode& node, std::size_t index) const {
        return steps_[static_cast<std::size_t>(node.children[index])];
    }
    int binary(FormulaOp op, const FormulaNode& node) {
        return builder_.operation(op, child(node, 0), child(node, 1));
    }

    int compile(const FormulaNode& node) {
        switch (node.kind) {
        case NodeKind::Number:
            return builder_.constant(node.number);
        case NodeKind::Reference:
            return reference(node);
        case NodeKind::RangeReference:
            fail(CellErrorCode::Type,
                 rangeName(node.range) + " is several cells where one volume is needed; name one cell.");
        case NodeKind::BrokenReference:
            fail(CellErrorCode::Ref, "The formula uses a cell that was deleted; choose another cell.");
        case NodeKind::Negate:
            return builder_.operation(FormulaOp::Negate, child(node, 0));
        case NodeKind::Add:
            return binary(FormulaOp::Add, node);
        case NodeKind::Subtract:
            return binary(FormulaOp::Subtract, node);
        case NodeKind::Multiply:
            return binary(FormulaOp::Multiply, node);
        case NodeKind::Divide:
            return binary(FormulaOp::Divide, node);
        case NodeKind::Call:
            break;
        }
        return call(node);
    }

    int call(const FormulaNode& node) {
        const FormulaFunction* function = findFunction(node.name);
        if (!function) {
            std::vector<std::string> names;
            std::string list;
            for (const FormulaFunction& known : formulaFunctions()) {
                names.emplace_back(known.name);
                list += (list.empty() ? "" : ", ") + names.back();
            }
            const std::string nearest = nearestName(node.name, names);
            fail(CellErrorCode::Name, "There is no function " + inQuotes(node.name) + "; " +
                                          (nearest.empty() ? "the functions are: " + list + "."
                                                           : "did you mean \"" + nearest + "\"?"));
        }
        const auto given = static_cast<int>(node.children.size());
        if (given < function->minArguments || given > function->maxArguments)
            fail(CellErrorCode::Type,
                 std::string(function->name) + " takes " + std::to_string(function->minArguments) +
                     (function->maxArguments == 1 ? " argument" : " arguments") + ", not " +
                     std::to_string(given) + "; correct the list in its parentheses.");
        return builder_.operation(function->op, child(node, 0), given > 1 ? child(node, 1) : -1);
    }

    int reference(const FormulaNode& node) {
        const SheetAddress named{node.name, node.range.first};
        if (const auto known = references_.find(named); known != references_.end()) return known->second;
        const int step = newReference(node);
        references_.emplace(named, step);
        return step;
    }

    int newReference(const FormulaNode& node) {
        const FormulaOperand operand = resolve_(node);
        if (const auto* error = std::get_if<CellError>(&operand.value)) throw CompileFailure{*error};
        if (const auto* waits = std::get_if<PendingValue>(&operand.value)) {
            if (pending_.empty()) pending_ = waits->dataset;
            return builder_.constant(0.0); // never computed: the whole formula is pending
        }
        if (const auto* dataset = std::get_if<DatasetValue>(&operand.value)) {
            join(operand.shown, dataset->grid);
            return builder_.input({dataset->dataset, operand.field, operand.timeStep});
        }
        const auto& formula = std::get<FormulaValue>(operand.value);
        join(operand.shown, formula.grid);
        for (const std::string& text : formula.notes)
            note(text);
        if (formula.plan.steps.size() > copiesLeft_) tooLarge();
        copiesLeft_ -= formula.plan.steps.size();
        return builder_.inlined(formula.plan);
    }

    void join(const std::string& shown, const Grid& grid) {
        if (!grid_) {
            grid_ = grid;
            firstShown_ = shown;
            return;
        }
        if (grid.dims != grid_->dims)
            fail(CellErrorCode::Grid, firstShown_ + " has " + shapeText(grid_->dims) + " samples and " +
                                          shown + " has " + shapeText(grid.dims) +
                                          "; formulas need cells of equal shape.");
        constexpr double tolerance = 1e-3;
        if (displacementVoxels(*grid_, grid) > tolerance)
            note(
                shown + " has the same number of samples as " + firstShown_ +
                " at other positions in the world; they were combined sample by sample at the positions of " +
                firstShown_ + ".");
    }

    void note(const std::string& text) {
        if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(text);
    }

    const FormulaAst& ast_;
    const std::function<FormulaOperand(const FormulaNode&)>& resolve_;
    PlanBuilder builder_;
    std::size_t& copiesLeft_;
    std::map<SheetAddress, int> references_;
    std::vector<int> steps_; ///< of each node
    std::optional<Grid> grid_;
    std::string firstShown_;
    std::string pending_;
    std::vector<std::string> notes_;
};

} // namespace

CellValue compileFormula(const FormulaAst& ast,
                         const std::function<FormulaOperand(const FormulaNode&)>& resolve,
                         std::size_t& copiesLeft) {
    try {
        return Compiler(ast, resolve, copiesLeft).run();
    } catch (const CompileFailure& failure) {
        return failure.error;
    }
}

} // namespace voxsheet::sheet
