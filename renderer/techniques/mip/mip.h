// Maximum intensity projection by a compute shader: the largest value along each ray, then classified.
//
// Samples sit as in raycast.h. The pixel is the table's colour at the largest sample, with the table's
// opacity as it is (not corrected for a length), premultiplied; NaN samples do not count, and a ray without
// samples is transparent.
#pragma once

#include "stages/shared_stages.h"

namespace voxsheet {

void drawMip(SharedStages& stages, const DrawRequest& request);

} // namespace voxsheet
