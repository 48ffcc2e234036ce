// Long compute work in parts: consumer GPUs are reset when one dispatch takes about two seconds.
#pragma once

#include "gpu/program.h"
#include "stages/picture_rows.h"

#include <glm/glm.hpp>

namespace voxsheet {

/// Rows of the picture, a multiple of 8, that one dispatch may draw so that it takes at most about 2^29
/// samples (some 0.1 s on a small GPU).
[[nodiscard]] int rowsPerDispatch(glm::ivec2 sizePixels, double samplesPerPixel);

/// Dispatches 8x8 groups over these rows of the picture in bands; sets the uniforms `targetSize` and
/// `firstRow`. Ends with a barrier that makes the picture visible.
void dispatchPicture(const gpu::Program& program, glm::ivec2 sizePixels, double samplesPerPixel,
                     const PictureRows& rows);

} // namespace voxsheet
