// The level-of-detail pyramid: each level is the volume-weighted mean of the level below.
#pragma once

#include "volume/stored_array.h"

#include <cstddef>
#include <vector>

namespace voxsheet {

/// Dimensions of the level above a level of `dims` samples: ceil(dims / 2) per axis.
[[nodiscard]] glm::ivec3 coarserDims(const glm::ivec3& dims);

/// The next coarser level of `finer`, in pyramidType(finer.type), coarserDims(finer.dims) samples, x fastest.
///
/// With n samples on an axis and m = ceil(n / 2), coarse sample c covers the finer samples over [c n/m, (c+1)
/// n/m] in units of finer samples: for even n two whole ones, for odd n up to three with the lengths of their
/// overlaps as weights. So the mean of the whole level is kept, every level spans the same texture interval
/// [0, 1] (grid.h), and periodic axes need no special care. Samples that are NaN or infinite are left out of
/// the mean; a coarse sample made of such samples only is NaN. 8- and 16-bit integers are rounded to nearest,
/// halves away from zero. Throws InvalidInput as validateStoredArray.
[[nodiscard]] std::vector<std::byte> coarserLevel(const StoredArray& finer);

} // namespace voxsheet
