// Builds plans step by step; equal steps become one (value numbering).
#pragma once

#include "sheet/formula/plan.h"

#include <cstddef>
#include <unordered_map>

namespace voxsheet::sheet {

class PlanBuilder {
public:
    /// Each gives the index of its step.
    int input(const PlanInput& input);
    int constant(double value);
    int operation(FormulaOp op, int a, int b = -1);
    /// The steps of another plan; the index of its result.
    int inlined(const FormulaPlan& plan);

    /// More than kMaxPlanSteps or kMaxPlanInputs.
    [[nodiscard]] bool isTooLarge() const;
    /// The plan that ends with step `result`.
    [[nodiscard]] FormulaPlan finish(int result) const;

private:
    int step(const PlanStep& step);

    struct StepHash {
        std::size_t operator()(const PlanStep& step) const;
    };

    FormulaPlan plan_;
    std::unordered_map<PlanStep, int, StepHash> known_;
};

} // namespace voxsheet::sheet
