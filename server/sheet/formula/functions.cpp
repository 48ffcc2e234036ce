#include "sheet/formula/functions.h"

#include "sheet/utf8.h"

#include <array>

namespace voxsheet::sheet {

namespace {

constexpr std::array<FormulaFunction, 1> kFunctions{{
    {"abs", 1, 1, FormulaOp::Abs, "The magnitude of every sample."},
}};

} // namespace

std::span<const FormulaFunction> formulaFunctions() { return kFunctions; }

const FormulaFunction* findFunction(std::string_view name) {
    const std::string lower = lowerAscii(name);
    for (const FormulaFunction& function : kFunctions)
        if (lower == function.name) return &function;
    return nullptr;
}

} // namespace voxsheet::sheet
