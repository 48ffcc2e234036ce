#include "sheet/formula/plan_builder.h"

#include <algorithm>
#include <functional>

namespace voxsheet::sheet {

std::size_t PlanBuilder::StepHash::operator()(const PlanStep& step) const {
    std::size_t hash = static_cast<std::size_t>(step.op);
    for (const std::size_t part :
         {std::hash<int>{}(step.a), std::hash<int>{}(step.b), std::hash<double>{}(step.constant)})
        hash = hash * 0x9E3779B97F4A7C15U + part;
    return hash;
}

int PlanBuilder::step(const PlanStep& step) {
    const auto [known, isNew] = known_.try_emplace(step, static_cast<int>(plan_.steps.size()));
    if (isNew) plan_.steps.push_back(step);
    return known->second;
}

int PlanBuilder::input(const PlanInput& input) {
    const auto found = std::find(plan_.inputs.begin(), plan_.inputs.end(), input);
    const auto index = static_cast<int>(found - plan_.inputs.begin());
    if (found == plan_.inputs.end()) plan_.inputs.push_back(input);
    return step({FormulaOp::Input, index, -1, 0.0});
}

int PlanBuilder::constant(double value) { return step({FormulaOp::Constant, -1, -1, value}); }

int PlanBuilder::operation(FormulaOp op, int a, int b) { return step({op, a, b, 0.0}); }

int PlanBuilder::inlined(const FormulaPlan& plan) {
    std::vector<int> here;
    for (const PlanStep& theirs : plan.steps) {
        if (theirs.op == FormulaOp::Input) {
            here.push_back(input(plan.inputs[static_cast<std::size_t>(theirs.a)]));
            continue;
        }
        PlanStep mine = theirs;
        if (mine.a >= 0) mine.a = here[static_cast<std::size_t>(mine.a)];
        if (mine.b >= 0) mine.b = here[static_cast<std::size_t>(mine.b)];
        here.push_back(step(mine));
    }
    return here.back();
}

bool PlanBuilder::isTooLarge() const {
    return plan_.steps.size() > kMaxPlanSteps || plan_.inputs.size() > kMaxPlanInputs;
}

FormulaPlan PlanBuilder::finish(int result) const {
    FormulaPlan plan = plan_;
    plan.steps.resize(static_cast<std::size_t>(result) + 1);
    return plan;
}

} // namespace voxsheet::sheet
