// Statistics and histogram of one field and step.
#pragma once

#include "volume/dataset.h"
#include "volume/stored_array.h"

namespace voxsheet {

inline constexpr int kHistogramBins = 256;

/// Over the finite samples, in values (valueScale * stored + valueOffset); NaN and infinite samples are
/// counted in nanCount and otherwise left out. Standard deviation is the population's: sqrt(mean((v -
/// mean)^2)). The histogram runs from min to max in kHistogramBins equal bins; when all values are equal they
/// are in bin 0. With no finite sample all numbers are 0. Throws InvalidInput as validateStoredArray.
[[nodiscard]] FieldStep computeStatistics(const StoredArray& array);

} // namespace voxsheet
