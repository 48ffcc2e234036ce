// Placing index axes in the world, as the headers of the formats describe it.
#pragma once

#include "volume/grid.h"

#include <array>
#include <string>
#include <vector>

namespace voxsheet::import {

using AxisColumns = std::array<glm::dvec3, 3>; ///< world vectors of one index step along i, j, k

[[nodiscard]] glm::dmat4 affine(const AxisColumns& columns, const glm::dvec3& origin);

/// RAS+ (x to the right, y to the front, z up) from LPS+, the frame of MetaImage, DICOM and many NRRD files.
[[nodiscard]] glm::dmat4 rasFromLps();

/// Sets the columns from `count` (1..3) on perpendicular to the ones before, as long as their mean: files of
/// one or two axes become volumes that are one voxel thick.
void completeAxes(AxisColumns& columns, int count);

/// Throws InvalidInput (subject `what`) unless every number is finite and not 0.
void checkSpacing(const std::string& what, const std::vector<double>& spacing);

/// Throws InvalidInput (subject `what`) unless the columns are finite and span space; `vectors` names them
/// ("voxel vectors").
void checkSpanSpace(const std::string& what, const char* vectors, const AxisColumns& columns);

} // namespace voxsheet::import
