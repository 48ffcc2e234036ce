// formula = '=' sum
// sum     = product { ('+' | '-') product }
// product = unary { ('*' | '/') unary }
// unary   = { '-' | '+' } primary
// primary = number | reference | function '(' [ sum { ',' sum } ] ')' | '(' sum ')'
#pragma once

#include "sheet/formula/ast.h"
#include "sheet/formula/cell_error.h"

#include <string_view>
#include <variant>

namespace voxsheet::sheet {

inline constexpr int kMaxFormulaDepth = 64; ///< of parentheses, calls and signs within each other

/// A text that is no formula is a #NAME? whose sentence names the character; a cell beyond the limits of a
/// sheet is #REF!.
[[nodiscard]] std::variant<FormulaAst, CellError> parseFormula(std::string_view text);

} // namespace voxsheet::sheet
