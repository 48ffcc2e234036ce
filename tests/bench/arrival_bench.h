// How smoothly a sheet moves while its volumes arrive from disk.
#pragma once

#include "bench/volume_bench.h"

#include <functional>
#include <string>

namespace voxsheet::bench {

/// Sixteen tiles of options.pixels squared, each of a volume of its own of options.samples per axis, in views
/// that turn, drawn with LevelChoice::AtHand until every tile is drawn from its own level; then
/// options.frames more. Gives one JSON object: times between the ends of two frames, until the first picture
/// and until all is there, and the frames' times afterwards, all in ms. Throws GpuError, IoError.
[[nodiscard]] std::string arrivalBench(const VolumeBenchOptions& options,
                                       const std::function<void(const std::string&)>& progress);

} // namespace voxsheet::bench
