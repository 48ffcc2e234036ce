// Times every path of every technique that has more than one on this device, on one analytic volume in three
// looks (filled, sparse, sharp peaks), and compares their pictures.
#pragma once

#include "bench/volume_bench.h"
#include "frame/path_choice.h"

#include <functional>
#include <string>
#include <vector>

namespace voxsheet::bench {

struct CalibrateOptions {
    int samples = 128; ///< of the volume, per axis
    int pixels = 384;  ///< of the square picture
    int frames =
        15; ///< per path, each one picture of every look; from six on the medians' confidence is 95 %
    int device = -1; ///< as RenderOptions::device
};

struct CalibratedTechnique {
    std::vector<MeasuredPath> measured; ///< one for each candidate
    RenderPath rule = RenderPath::Shader;
    CalibratedPath chosen; ///< by fastestPath; without a date
};

struct Calibration {
    RenderDevice device;
    std::vector<CalibratedTechnique> techniques; ///< that have more than one path
};

/// The paths take turns, frame by frame, while the camera goes round. `progress` is told each technique.
/// Throws as RenderThread, and GpuError with a tile's error.
[[nodiscard]] Calibration calibrate(const CalibrateOptions& options,
                                    const std::function<void(const std::string&)>& progress);

} // namespace voxsheet::bench
