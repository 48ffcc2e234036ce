// Computes the solid where a volume is above or below a value into the store, as signed distances: a clip
// object made of data.
#pragma once

#include "engine/computed_entry.h"
#include "engine/entry_jobs.h"
#include "engine/formula_job.h"
#include "store/volume_store.h"
#include "volume/signed_distance.h"
#include "volume/volume_provider.h"

#include <cstdint>
#include <memory>
#include <string>

namespace voxsheet::engine {

struct ThresholdTask {
    FormulaInput input; ///< the array that is compared
    Threshold threshold;
    std::string text; ///< as typed, for people: "B1 > 0.4"
};

/// Store key of the result: the same comparison with the same array has the same.
[[nodiscard]] std::string thresholdEntryKey(const ThresholdTask& task);

/// Bytes of memory that computeThreshold needs at its peak.
[[nodiscard]] std::uint64_t thresholdMemoryBytes(const ThresholdTask& task);

/// The entry, to be committed, whose field 0, step 0 holds the distances of volume/signed_distance.h, of
/// level 0 of the input. Uses the entry that the store has, or makes it. Throws LimitExceeded if
/// thresholdMemoryBytes exceeds the budget, Cancelled, and what store and provider throw.
[[nodiscard]] ComputedEntry computeThreshold(const ThresholdTask& task, const store::VolumeStore& store,
                                             const VolumeProvider& volumes, std::uint64_t memoryBudgetBytes,
                                             const JobControl& control);

/// Whether field 0 holds signed distances, so that the dataset can be a clip object as it is.
[[nodiscard]] bool holdsSignedDistances(const DatasetMeta& meta);

} // namespace voxsheet::engine
