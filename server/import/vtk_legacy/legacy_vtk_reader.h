// Legacy VTK files (.vtk) with structured points or rectilinear grids.
#pragma once

#include "import/source_reader.h"

#include <memory>

namespace voxsheet::import {

/// ASCII and binary, versions 1 to 5.1; point data, or cell data where there is none; each component of each
/// numeric array is a field. Rectilinear grids are resampled to uniform ones (formats/rectilinear_axes.h).
/// Other data sets are Unsupported.
///
/// Not by VTK: its reader takes a truncated or lying file for a whole one, and the check that would prevent
/// this has to walk over every array, after which nothing is left to do but to read the numbers.
[[nodiscard]] std::unique_ptr<SourceReader> makeLegacyVtkReader();

} // namespace voxsheet::import
