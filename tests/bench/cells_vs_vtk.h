// A sheet of cells that all move, by Voxsheet and by one window of VTK's with a renderer per cell.
#pragma once

#include "bench/volume_bench.h"

#include <string>
#include <vector>

namespace voxsheet::bench {

/// 25 volumes of 128^3 at 256x256 each (a quarter of that for smaller options.samples), filled, as
/// bench_vs_vtk gives a case; nothing if options.only is not in its name. PSNR: over the whole sheet, of
/// every fourth pixel, to the converged pictures.
[[nodiscard]] std::vector<std::string> cellsAgainstVtk(const VolumeBenchOptions& options);

} // namespace voxsheet::bench
