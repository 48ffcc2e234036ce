// Pre-integrated transfer functions: the mean of extinction, and of colour times extinction, over the values
// between the ends of a stretch, as if positions over the range changed linearly along it. Sharp peaks that
// lie between two samples are not missed then.
//
// Engel, Kraus, Ertl, "High-quality pre-integrated volume rendering using hardware-accelerated pixel shading"
// (Graphics Hardware 2001), in the approximation that needs only a one-dimensional table of integrals
// (section 3.2): what a stretch absorbs of its own light is left out of colours.
#pragma once

#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet {

/// Extinctions from here on count as this one, which halves light 64 times per unit length: sums of larger
/// ones would leave nothing of thin material in 32 bits.
constexpr double kLargestMeanExtinction = 64.0;

/// Integrals over the entries of shaderTable(table): element i over the first i of them, of rgb times
/// extinction and of extinction; one element more than entries. Between elements they are linear, and beyond
/// the ends go on so.
[[nodiscard]] std::vector<glm::vec4> integralTable(const TransferTable& table);

} // namespace voxsheet
