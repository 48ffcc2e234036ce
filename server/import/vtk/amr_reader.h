// AMR data sets of VTK (.vth, .vthb, .vtm): patches of image data, resampled to one uniform grid.
#pragma once

#include "import/source_reader.h"

#include <memory>

namespace voxsheet::import {

/// Fields are the arrays of the cells, which all patches must have; each patch is a .vti file beside the
/// header or below, read as makeVtiReader does. How the grid comes about: formats/patch_resampling.h.
/// Patches with values at points alone, or turned, are Unsupported.
[[nodiscard]] std::unique_ptr<SourceReader> makeAmrReader();

} // namespace voxsheet::import
