// TIFF and BigTIFF: the pages of a file are the slices of a volume, with the hyperstacks of ImageJ and OME
// (channels become fields, frames time steps). i is the column, j the row and k the slice, and the world is
// the index times the spacing: y grows from row to row, downwards in a picture viewer, z from slice to slice.
// So the frame is right-handed, and a slice seen along +z with y down looks as it does in ImageJ.
#pragma once

#include "import/source_reader.h"

#include <memory>

namespace voxsheet::import {

/// Integers of 1 to 16, 32 and 64 bits, floats of 16 (as f32), 32 and 64; grey, RGB, CMYK, palettes of up to
/// 8 bits (as RGB; under ImageJ, whose palettes are for display, as the numbers themselves). The orientation
/// tag decides where rows and columns lie in the world. Strips and tiles, all compressions of libtiff.
/// Thumbnails and masks among the pages are left out, with a note. Every other page must be of one size and
/// type.
[[nodiscard]] std::unique_ptr<SourceReader> makeTiffReader();

} // namespace voxsheet::import
