#include "base/errors.h"
#include "sheet/formula/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

namespace voxsheet::sheet {

namespace {

// Short runs, so that the intermediate results of all steps stay in the processor's caches.
constexpr std::size_t kRun = 512;

using Registers = std::vector<double>;

void load(const PlanArray& array, std::size_t begin, std::span<double> out) {
    std::visit(
        [&](const auto& values) {
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(begin), out.size(), out.begin());
        },
        array);
}

template <typename Operation>
void unary(const double* a, std::span<double> out, Operation operation) {
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = operation(a[i]);
}

template <typename Operation>
void binary(const double* a, const double* b, std::span<double> out, Operation operation) {
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = operation(a[i], b[i]);
}

void runStep(const PlanStep& step, std::span<const PlanArray> inputs, std::size_t begin,
             const Registers& registers, std::span<double> out) {
    const auto operand = [&](int index) { return registers.data() + static_cast<std::size_t>(index) * kRun; };
    switch (step.op) {
    case FormulaOp::Input:
        load(inputs[static_cast<std::size_t>(step.a)], begin, out);
        break;
    case FormulaOp::Constant:
        std::fill(out.begin(), out.end(), step.constant);
        break;
    case FormulaOp::Negate:
        unary(operand(step.a), out, [](double a) { return -a; });
        break;
    case FormulaOp::Add:
        binary(operand(step.a), operand(step.b), out, [](double a, double b) { return a + b; });
        break;
    case FormulaOp::Subtract:
        binary(operand(step.a), operand(step.b), out, [](double a, double b) { return a - b; });
        break;
    case FormulaOp::Multiply:
        binary(operand(step.a), operand(step.b), out, [](double a, double b) { return a * b; });
        break;
    case FormulaOp::Divide:
        // A quotient by zero must stay absent in later steps too: 1 / (1 / 0) is not 0.
        binary(operand(step.a), operand(step.b), out, [](double a, double b) {
            return b == 0.0 ? std::numeric_limits<double>::quiet_NaN() : a / b;
        });
        break;
    case FormulaOp::Abs:
        unary(operand(step.a), out, [](double a) { return std::abs(a); });
        break;
    }
}

float storable(double value) {
    const bool finite = std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
    return finite ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
}

} // namespace

void evaluatePlan(const FormulaPlan& plan, std::span<const PlanArray> inputs, std::span<float> out) {
    if (inputs.size() != plan.inputs.size() || plan.steps.empty())
        throw InvalidInput("formula", "needs " + std::to_string(plan.inputs.size()) + " arrays, but " +
                                          std::to_string(inputs.size()) + " were given");
    for (const PlanArray& array : inputs) {
        const std::size_t size = std::visit([](const auto& values) { return values.size(); }, array);
        if (size != out.size())
            throw InvalidInput("formula", "an array has " + std::to_string(size) + " samples, the result " +
                                              std::to_string(out.size()));
    }
    Registers registers(plan.steps.size() * kRun);
    for (std::size_t begin = 0; begin < out.size(); begin += kRun) {
        const std::size_t count = std::min(kRun, out.size() - begin);
        for (std::size_t i = 0; i < plan.steps.size(); ++i)
            runStep(plan.steps[i], inputs, begin, registers, std::span(registers).subspan(i * kRun, count));
        const double* result = registers.data() + (plan.steps.size() - 1) * kRun;
        std::transform(result, result + count, out.begin() + static_cast<std::ptrdiff_t>(begin), storable);
    }
}

} // namespace voxsheet::sheet
