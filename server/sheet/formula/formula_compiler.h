// One formula, its references resolved, into a plan.
#pragma once

#include "sheet/formula/ast.h"
#include "sheet/formula/values.h"

#include <cstddef>
#include <functional>
#include <string>

namespace voxsheet::sheet {

/// What a reference stands for.
struct FormulaOperand {
    std::string shown;                  ///< the reference, for messages
    CellValue value;                    ///< PendingValue, DatasetValue, FormulaValue or CellError
    FieldChoice field{std::int64_t{0}}; ///< DatasetValue: what the cell shows of it
    int timeStep = 0;
};

/// FormulaValue, PendingValue or CellError; an error goes before what is pending, the leftmost error first.
/// \param copiesLeft  how many steps of other formulas may still be copied into plans; counts down
[[nodiscard]] CellValue compileFormula(const FormulaAst& ast,
                                       const std::function<FormulaOperand(const FormulaNode&)>& resolve,
                                       std::size_t& copiesLeft);

} // namespace voxsheet::sheet
