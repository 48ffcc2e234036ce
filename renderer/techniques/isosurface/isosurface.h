// Isosurfaces found in the volume texture, with no polygons (Khanduja & Karki 2007, section 3, "Isosurface
// Extraction"; the refinement after Hadwiger et al. 2005).
//
// Along a ray the interpolated value is looked at from the beginning of the kept span on, in steps of
// tile.sampleDistanceVoxels of the drawn level, and at the span's end. Where it passes one of the values
// within a step, the crossing is enclosed by regula falsi and short steps until it is known to 0.01 voxel.
// Crossings are composited front to back with their surface's own alpha. Where the value was heading for a
// surface and did not reach it by the end of a step, the turn in between is looked for, so that both
// crossings of a ridge within a step are found; a ridge that begins and ends within one step is not. A
// crossing that the clip object removes does not count. A step that touches NaN has no crossing.
//
// Caps: where the ray enters what is kept through a clip plane or the clip object, inside the surface (at or
// above the smallest positive value or at or below the largest negative one; with neither, at or above the
// smallest), the cut is opaque and coloured by the transfer table.
//
// IsosurfaceMethod::AlphaTest, for comparison: the samples of raycast.h, and one counts as hit when it is
// within 1/128 of the volume's range of a value: the paper's test on 8-bit alpha in other words. It leaves
// gaps where values change fast.
#pragma once

#include "stages/shared_stages.h"

namespace voxsheet {

/// Throws InvalidInput (field isovalue) if there are too many values or one is not finite.
void validateIsosurface(const IsosurfaceSpec& isosurface);

void drawIsosurface(SharedStages& stages, const DrawRequest& request);

} // namespace voxsheet
