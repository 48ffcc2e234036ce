// VTK XML image data (.vti) and rectilinear grids (.vtr), decoded by VTK after a check of our own.
#pragma once

#include "import/source_reader.h"

#include <memory>

namespace voxsheet::import {

/// Single-piece files of every encoding (ascii, binary, appended raw and base64; zlib, LZ4, LZMA). Point
/// data, or cell data where there is none; each component of each numeric array is a field. Rectilinear grids
/// are resampled to uniform ones (formats/rectilinear_axes.h). Other VTK XML files are Unsupported.
[[nodiscard]] std::unique_ptr<SourceReader> makeVtiReader();

} // namespace voxsheet::import
