// `voxsheet bench calibrate`: measures the paths of each technique and remembers the fastest.
#pragma once

#include "bench/calibrate_bench.h"

#include <nlohmann/json.hpp>

namespace voxsheet::cli {

/// {"device", "renderer", "file", "cases": [{"technique", "path", "ms", "ms_low", "ms_high", "pixels_apart",
/// "same_picture", "rule", "chosen"}], "chosen": {TECHNIQUE: {"path", "ratio", "date"}}}. Throws as
/// bench::calibrate, and IoError if the result cannot be written.
[[nodiscard]] nlohmann::json runCalibration(const bench::CalibrateOptions& options);

/// {"file", "cases": [{"forgotten"}]}. Throws GpuError, IoError.
[[nodiscard]] nlohmann::json forgetCalibration(int device);

} // namespace voxsheet::cli
