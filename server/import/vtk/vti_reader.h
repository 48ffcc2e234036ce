// VTK XML image data (.vti), decoded by VTK after a check of our own.
#pragma once

#include "import/source_reader.h"

#include <memory>

namespace voxsheet::import {

/// Single-piece files of every encoding (ascii, binary, appended raw and base64; zlib, LZ4, LZMA). Point
/// data, or cell data where there is none; each component of each numeric array is a field. Other VTK XML
/// files are Unsupported.
[[nodiscard]] std::unique_ptr<SourceReader> makeVtiReader();

} // namespace voxsheet::import
