// The bench of what looks inside a volume: volume rendering (VR), surfaces of cuts (SR), voxelized clipping
// (VC) and isosurfaces (IE), with and without light, as in figures 6 and 7 of Khanduja & Karki 2007 at N = 1;
// and what clipping saves.
#pragma once

#include "bench/volume_bench.h"

#include <functional>
#include <string>
#include <vector>

namespace voxsheet::bench {

/// One picture to time, over the bench's volume ("bench") and its clip objects ("clip-shape:…").
struct InsideCase {
    std::string name; ///< "256^3 u8 512x512 ie lit"
    TileSpec tile;
};

/// The cases of benchVolume on its grid: for each technique without and with light; then `clip 1/8 by planes`
/// and `clip 1/8 by object`: the volume rendering that is left when seven eighths of the box are cut away.
/// Throws InvalidInput for a technique that is not vr, sr, vc, ie or all.
[[nodiscard]] std::vector<InsideCase> insideCases(const VolumeBenchOptions& options, const Grid& grid);

/// Of benchVolume.
[[nodiscard]] Grid insideGrid(int samples);

/// The tile of a case as the camera goes round.
[[nodiscard]] TileSpec turned(const InsideCase& one, const Grid& grid, int frame);

/// {"device", "renderer", "cases": [{"name", "ms", "cpu_ms", "samples", "psnr", "p999"}]}: psnr against the
/// double-precision truth at the same sample positions, over about 64 x 64 pixels.
[[nodiscard]] std::string insideBench(const VolumeBenchOptions& options,
                                      const std::function<void(const std::string&)>& progress);

} // namespace voxsheet::bench
