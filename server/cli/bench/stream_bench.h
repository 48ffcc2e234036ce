// `voxsheet bench stream`: from input to pixels over loopback, with the program's own server.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace voxsheet::cli {

struct StreamBenchOptions {
    std::vector<int> cells{1, 9, 25};
    int dim = 128;
    int width = 1280; ///< of the whole sheet, device pixels
    int height = 800;
    double seconds = 5.0; ///< of dragging per case
    int device = -1;
    std::string keep; ///< folder that keeps volumes and store for the next run; empty: a temporary one
};

/// {"bench": "stream", "device", "dim", "size", "cases": [{cells, tile, frames_per_s, latency_ms_p50,
/// latency_ms_p95, bytes_per_frame, scale, final_ms, first_picture_ms}]}. latency: from posting a view to the
/// last decoded pixel of the frame that shows it; final_ms: from the end of the drag to the last final
/// picture.
[[nodiscard]] nlohmann::json runStreamBench(const StreamBenchOptions& options);

} // namespace voxsheet::cli
