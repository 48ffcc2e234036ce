// Which axes of an NRRD file are space, which are fields and which time; and where the grid lies.
#pragma once

#include "import/formats/nrrd_header.h"
#include "volume/dataset.h"

#include <string>
#include <vector>

namespace voxsheet::import {

struct NrrdRoles {
    std::vector<std::size_t> spatial; ///< 1..3 axes, next to each other
    std::vector<std::size_t> inner;   ///< faster than space: components of a voxel
    std::vector<std::size_t> outerFields;
    std::vector<std::size_t> time; ///< at most one, slower than space
    bool timeFastest = false;      ///< time varies faster than outerFields
};

/// Directions decide, else kinds, else the first three axes are space. Of slower axes, kind "list" or a
/// vector kind means fields; "time" and unnamed ones mean time. Throws Unsupported for other arrangements,
/// with the file's name.
[[nodiscard]] NrrdRoles nrrdRoles(const std::string& name, const NrrdHeader& header);

/// Grid (dims, worldFromIndex, centring), lengthUnit, anatomical, notes. Throws InvalidInput for impossible
/// geometry.
void placeNrrdGrid(const std::string& name, const NrrdHeader& header, const NrrdRoles& roles,
                   DatasetMeta& meta);

/// Names for the values of a component axis by its kind; empty when the kind has none.
[[nodiscard]] std::vector<std::string> nrrdComponentNames(const NrrdAxis& axis);

} // namespace voxsheet::import
