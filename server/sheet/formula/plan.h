// What to compute, flattened: no sheets, cells or names are left, only arrays in and one array out.
#pragma once

#include "sheet/typed_style.h"

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace voxsheet::sheet {

/// One array of source values: a dataset's field at a time step, as the referenced cell shows it.
struct PlanInput {
    std::string dataset; ///< its name in the workbook
    FieldChoice field{std::int64_t{0}};
    int timeStep = 0;
    bool operator==(const PlanInput&) const = default;
};

enum class FormulaOp { Input, Constant, Negate, Add, Subtract, Multiply, Divide, Abs };

struct PlanStep {
    FormulaOp op = FormulaOp::Constant;
    int a = -1;            ///< operand: an earlier step; Input: index into `inputs`
    int b = -1;            ///< second operand of two
    double constant = 0.0; ///< Constant
    bool operator==(const PlanStep&) const = default;
};

/// Steps in order, each the operation of earlier ones; the last is the result. Equal steps occur once, so
/// that formulas over formulas stay linear in size.
struct FormulaPlan {
    std::vector<PlanInput> inputs;
    std::vector<PlanStep> steps;
    bool operator==(const FormulaPlan&) const = default;
};

inline constexpr std::size_t kMaxPlanSteps = 4096;
inline constexpr std::size_t kMaxPlanInputs = 256;
/// Steps that one workbook may copy from formula to formula: a chain of n formulas copies n^2 / 2.
inline constexpr std::size_t kMaxCopiedSteps = std::size_t{1} << 20;

/// Identifies the result: equal text, equal voxels. \param inputKeys one per input, naming exactly the array
/// that is read (store key, field, step). Throws InvalidInput if their number is wrong.
[[nodiscard]] std::string planCacheKey(const FormulaPlan& plan, std::span<const std::string> inputKeys);

using PlanArray = std::variant<std::span<const float>, std::span<const double>>;

/// Computes any run of samples: a slab, a brick or all. Arithmetic in double precision, the result rounded to
/// float. NaN (an absent sample) in an input that the sample depends on gives NaN; so do a division by zero,
/// whatever is divided, and any result that a float cannot hold: there is no infinity in a volume. Throws
/// InvalidInput if an array is absent or its size differs from the output's.
void evaluatePlan(const FormulaPlan& plan, std::span<const PlanArray> inputs, std::span<float> out);

} // namespace voxsheet::sheet
