// The techniques that march along rays, on the processor's vector units: the pictures of the shaders of the
// same names, to within 1/255 (tests/image). For machines whose OpenGL runs on the processor anyway.
//
// Compiled for several instruction sets; the best that the processor has is taken at run time (Highway's
// dynamic dispatch).
#pragma once

#include "simd/picture_job.h"

namespace voxsheet::simd {

/// Each draws rows [firstRow, endRow) of a picture into job.pixels; firstRow a multiple of 8. Safe to call
/// from several threads for disjoint rows.
using Kernel = void (*)(const PictureJob& job, int firstRow, int endRow);

void raycastRows(const PictureJob& job, int firstRow, int endRow);    ///< techniques/raycast/raycast.h
void slicingRows(const PictureJob& job, int firstRow, int endRow);    ///< techniques/slicing/slicing.h
void isosurfaceRows(const PictureJob& job, int firstRow, int endRow); ///< techniques/isosurface/isosurface.h
void mipRows(const PictureJob& job, int firstRow, int endRow);        ///< techniques/mip/mip.h

/// Of the instruction set in use, for logs and reports: "AVX2".
[[nodiscard]] const char* instructionSet();

} // namespace voxsheet::simd
