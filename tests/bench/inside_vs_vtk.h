// What looks inside a volume, by Voxsheet and by VTK in turn: light, cropping, clipping planes, a clip object
// against a mask, isosurfaces against the isosurface blend mode and against extracted polygons.
#pragma once

#include "bench/volume_bench.h"

#include <string>
#include <vector>

namespace voxsheet::bench {

/// One JSON object per case, as bench_vs_vtk gives them. Distances are to the converged picture, by our
/// truth; VTK's mask keeps whole voxels, so its own lies farther off.
[[nodiscard]] std::vector<std::string> insideAgainstVtk(const VolumeBenchOptions& options);

} // namespace voxsheet::bench
