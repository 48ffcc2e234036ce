// One array of samples as it stands in memory or in the store, with what its numbers mean.
#pragma once

#include "volume/scalar_type.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace voxsheet {

/// A view: x fastest, then y, then z; native byte order. value = valueScale * stored + valueOffset.
struct StoredArray {
    ScalarType type = ScalarType::F32;
    glm::ivec3 dims{1};
    std::span<const std::byte>
        samples; ///< dims.x * dims.y * dims.z * scalarBytes(type) bytes, aligned for the type
    double valueScale = 1.0;
    double valueOffset = 0.0;
};

/// Throws InvalidInput if a dimension is < 1 or the number of bytes does not fit dims and type.
void validateStoredArray(const StoredArray& array);

} // namespace voxsheet
