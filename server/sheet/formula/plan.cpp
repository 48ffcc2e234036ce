#include "sheet/formula/plan.h"

#include "base/errors.h"
#include "sheet/number_text.h"

namespace voxsheet::sheet {

namespace {

const char* opName(FormulaOp op) {
    switch (op) {
    case FormulaOp::Input:
        return "in";
    case FormulaOp::Constant:
        return "const";
    case FormulaOp::Negate:
        return "neg";
    case FormulaOp::Add:
        return "add";
    case FormulaOp::Subtract:
        return "sub";
    case FormulaOp::Multiply:
        return "mul";
    case FormulaOp::Divide:
        return "div";
    case FormulaOp::Abs:
        break;
    }
    return "abs";
}

} // namespace

std::string planCacheKey(const FormulaPlan& plan, std::span<const std::string> inputKeys) {
    if (inputKeys.size() != plan.inputs.size())
        throw InvalidInput("formula", "has " + std::to_string(plan.inputs.size()) + " inputs but " +
                                          std::to_string(inputKeys.size()) + " keys were given");
    std::string key = "formula 1";
    for (const PlanStep& step : plan.steps) {
        key += std::string("\n") + opName(step.op);
        if (step.op == FormulaOp::Constant)
            key += " " + numberText(step.constant);
        else if (step.op == FormulaOp::Input)
            key += " " + inputKeys[static_cast<std::size_t>(step.a)];
        else
            key += " " + std::to_string(step.a);
        if (step.b >= 0) key += " " + std::to_string(step.b);
    }
    return key;
}

} // namespace voxsheet::sheet
