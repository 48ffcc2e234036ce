// Computes a formula's volume into the store, slab by slab on all threads, from level-0 source values.
#pragma once

#include "engine/computed_entry.h"
#include "engine/entry_jobs.h"
#include "sheet/formula/plan.h"
#include "store/volume_store.h"
#include "volume/volume_provider.h"

#include <memory>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// One array that the plan reads.
struct FormulaInput {
    std::shared_ptr<const DatasetMeta> meta;
    int field = 0;
    int step = 0;
};

struct FormulaTask {
    sheet::FormulaPlan plan;
    std::vector<FormulaInput> inputs; ///< one per plan.inputs, all of equal dims; at least one
    std::string formula;              ///< as typed, for people
};

/// Store key of the result: the same plan over the same arrays in the same geometry has the same.
[[nodiscard]] std::string formulaEntryKey(const FormulaTask& task);

/// What values mean: the words of FieldMeta.
struct ValueMeaning {
    std::string quantity;
    std::string unit;

    bool operator==(const ValueMeaning&) const = default;
};

/// Of the result. Quantity and unit, each for itself, are kept by sums and differences of arrays that agree
/// in it, by signs and by pure factors; empty for anything else.
[[nodiscard]] ValueMeaning formulaMeaning(const sheet::FormulaPlan& plan,
                                          const std::vector<ValueMeaning>& inputs);

/// Bytes of memory that computeFormula needs at its peak.
[[nodiscard]] std::uint64_t formulaMemoryBytes(const FormulaTask& task);

/// The entry, to be committed: the geometry of the first input, one field, one step, float. Uses the entry
/// that the store has, or makes it. Throws LimitExceeded if formulaMemoryBytes exceeds the budget, Cancelled,
/// and what store and provider throw.
[[nodiscard]] ComputedEntry computeFormula(const FormulaTask& task, const store::VolumeStore& store,
                                           const VolumeProvider& volumes, std::uint64_t memoryBudgetBytes,
                                           const JobControl& control);

} // namespace voxsheet::engine
