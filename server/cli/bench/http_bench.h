// `voxsheet bench http`: requests per second and their latency over loopback, with the program's own server.
#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace voxsheet::cli {

struct HttpBenchOptions {
    std::vector<int> clients{1, 4, 16}; ///< at the same time, each with one connection that it keeps
    double seconds = 3.0;               ///< per case
    int dim = 64;                       ///< samples per edge of the volume that the cell shows
    int width = 320;                    ///< of the cell's picture, pixels
    int height = 240;
    int device = -1;
};

/// {"bench": "http", "dim", "size", "cases": [{route, clients, requests, requests_per_s, latency_ms_p50,
/// latency_ms_p95, latency_ms_p99, bytes_per_response, refused}]}. Routes: health, api, files, image_cached
/// (the same picture each time), image_drawn (another camera for each request). A request that is answered
/// with 503 counts as refused and not as a request; its client does not wait before the next one. Throws
/// IoError if there is no answer, InternalError at any other status.
[[nodiscard]] nlohmann::json runHttpBench(const HttpBenchOptions& options);

} // namespace voxsheet::cli
