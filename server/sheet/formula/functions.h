// The functions of formulas. A new one is a row of the table here and a case in plan.cpp and evaluate.cpp.
#pragma once

#include "sheet/formula/plan.h"

#include <span>
#include <string>
#include <string_view>

namespace voxsheet::sheet {

struct FormulaFunction {
    const char* name; ///< lower case
    int minArguments;
    int maxArguments;
    FormulaOp op;
    const char* doc; ///< one sentence
};

[[nodiscard]] std::span<const FormulaFunction> formulaFunctions();
/// nullptr if there is none; whatever the case.
[[nodiscard]] const FormulaFunction* findFunction(std::string_view name);

} // namespace voxsheet::sheet
