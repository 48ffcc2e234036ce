#include "cli/bench/stream_bench.h"

#include "bench/scratch_folder.h"
#include "cli/bench/percentile.h"
#include "cli/bench/served_volumes.h"
#include "cli/bench/stream_probe.h"
#include "sheet/layout.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <vector>

namespace voxsheet::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Importing a sheet of large volumes takes its time on a busy machine.
constexpr double kPatienceSecondsPerSample = 5e-7;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

nlohmann::json viewOf(const engine::Engine& engine, glm::ivec2 tile, double azimuth, bool moving) {
    nlohmann::json tiles = nlohmann::json::array();
    for (const auto& [address, cell] : engine.snapshot()->sheets.front().cells)
        tiles.push_back({{"cell", sheet::addressName(address)}, {"width", tile.x}, {"height", tile.y}});
    return {{"tiles", tiles}, {"moving", moving}, {"style", {{"camera.azimuth", azimuth}}}};
}

nlohmann::json runCase(const StreamBenchOptions& options, int cells) {
    const bench::ScratchFolder scratch;
    const auto folder = options.keep.empty() ? scratch.path() : std::filesystem::path(options.keep);
    std::filesystem::create_directories(folder);
    const auto start = Clock::now();
    const ServedVolumes served(cells, options.dim, options.device, folder);
    StreamProbe probe(served.port(), served.engine().snapshot()->sheets.front().name);
    const auto layout = sheet::chooseLayout(static_cast<std::size_t>(cells));
    const glm::ivec2 tile{options.width / layout.columns, options.height / layout.rows};
    probe.post(viewOf(served.engine(), tile, 30.0, false));
    const double patience = 120.0 + kPatienceSecondsPerSample * cells * std::pow(options.dim, 3);
    if (!probe.waitFinal(static_cast<std::size_t>(cells), patience))
        throw IoError("stream bench",
                      "no picture came within " + std::to_string(std::lround(patience)) + " s");
    const double firstPictureMs = secondsSince(start) * 1e3;
    static_cast<void>(probe.takeFrames());

    const auto drag = Clock::now();
    double azimuth = 30.0;
    while (secondsSince(drag) < options.seconds) {
        azimuth += 1.0;
        probe.post(viewOf(served.engine(), tile, azimuth, true));
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    const auto frames = probe.takeFrames();
    const double dragSeconds = secondsSince(drag);
    const auto release = Clock::now();
    probe.post(viewOf(served.engine(), tile, azimuth, false));
    const bool final = probe.waitFinal(static_cast<std::size_t>(cells), 60.0);
    const double finalMs = secondsSince(release) * 1e3;

    std::vector<double> latencies;
    std::vector<double> scales;
    double bytes = 0.0;
    for (const auto& frame : frames) {
        latencies.push_back(frame.latencyMs);
        scales.push_back(frame.scale);
        bytes += static_cast<double>(frame.bytes);
    }
    const auto count = static_cast<double>(frames.size());
    return {{"cells", cells},
            {"tile", {tile.x, tile.y}},
            {"frames_per_s", count / dragSeconds},
            {"latency_ms_p50", percentile(latencies, 0.5)},
            {"latency_ms_p95", percentile(latencies, 0.95)},
            {"bytes_per_frame", count > 0 ? bytes / count : 0.0},
            {"scale", percentile(scales, 0.5)},
            {"final_ms", final ? nlohmann::json(finalMs) : nlohmann::json()},
            {"first_picture_ms", firstPictureMs}};
}

} // namespace

nlohmann::json runStreamBench(const StreamBenchOptions& options) {
    nlohmann::json result{
        {"bench", "stream"}, {"dim", options.dim}, {"size", {options.width, options.height}}};
    result["cases"] = nlohmann::json::array();
    for (const int cells : options.cells) {
        std::fprintf(stderr, "bench stream: %d cells\n", cells);
        result["cases"].push_back(runCase(options, cells));
    }
    return result;
}

} // namespace voxsheet::cli
