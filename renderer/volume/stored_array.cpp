#include "volume/stored_array.h"

#include "base/errors.h"
#include "volume/grid.h"

#include <cstdint>
#include <string>

namespace voxsheet {

void validateStoredArray(const StoredArray& array) {
    const auto& n = array.dims;
    const auto shape = std::to_string(n.x) + " x " + std::to_string(n.y) + " x " + std::to_string(n.z);
    if (n.x < 1 || n.y < 1 || n.z < 1)
        throw InvalidInput("array of " + shape + " samples", "every axis needs at least one sample");
    const auto expected = static_cast<std::uint64_t>(sampleCount(n)) * scalarBytes(array.type);
    if (array.samples.size() != expected)
        throw InvalidInput("array of " + shape + " samples",
                           "it holds " + std::to_string(array.samples.size()) + " bytes and not " +
                               std::to_string(expected));
}

} // namespace voxsheet
