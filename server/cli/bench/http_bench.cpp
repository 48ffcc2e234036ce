#include "cli/bench/http_bench.h"

#include "base/errors.h"
#include "bench/scratch_folder.h"
#include "cli/bench/percentile.h"
#include "cli/bench/served_volumes.h"

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <future>
#include <string>

namespace voxsheet::cli {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Path of the n-th request of a case.
using PathOf = std::function<std::string(int n)>;

struct Route {
    const char* name;
    PathOf path;
};

/// What one client saw.
struct Seen {
    std::vector<double> latenciesMs;
    double bytes = 0.0;
    int refused = 0;
};

Seen askUntil(Clock::time_point end, int port, const PathOf& path, std::atomic<int>& next) {
    httplib::Client client("127.0.0.1", port);
    client.set_keep_alive(true);
    client.set_tcp_nodelay(true);
    client.set_read_timeout(std::chrono::seconds(60));
    Seen seen;
    do {
        const auto target = path(next++);
        const auto start = Clock::now();
        const auto answer = client.Get(target);
        const double ms = secondsSince(start) * 1e3;
        if (!answer) throw IoError("bench http", "no answer to GET " + target);
        if (answer->status == 503) {
            ++seen.refused;
            continue;
        }
        if (answer->status != 200)
            throw InternalError("GET " + target, "it was answered with " + std::to_string(answer->status) +
                                                     ": " + answer->body);
        seen.latenciesMs.push_back(ms);
        seen.bytes += static_cast<double>(answer->body.size());
    } while (Clock::now() < end);
    return seen;
}

nlohmann::json runCase(const HttpBenchOptions& options, int port, const Route& route, int clients,
                       std::atomic<int>& next) {
    std::fprintf(stderr, "bench http: %s, %d clients\n", route.name, clients);
    const auto start = Clock::now();
    const auto end =
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
    std::vector<std::future<Seen>> running;
    for (int i = 0; i < clients; ++i)
        running.push_back(
            std::async(std::launch::async, [&] { return askUntil(end, port, route.path, next); }));
    Seen all;
    for (auto& each : running) {
        const auto seen = each.get();
        all.latenciesMs.insert(all.latenciesMs.end(), seen.latenciesMs.begin(), seen.latenciesMs.end());
        all.bytes += seen.bytes;
        all.refused += seen.refused;
    }
    const auto requests = static_cast<double>(all.latenciesMs.size());
    return {{"route", route.name},
            {"clients", clients},
            {"requests", all.latenciesMs.size()},
            {"requests_per_s", requests / secondsSince(start)},
            {"latency_ms_p50", percentile(all.latenciesMs, 0.50)},
            {"latency_ms_p95", percentile(all.latenciesMs, 0.95)},
            {"latency_ms_p99", percentile(all.latenciesMs, 0.99)},
            {"bytes_per_response", requests > 0 ? all.bytes / requests : 0.0},
            {"refused", all.refused}};
}

std::vector<Route> routesOf(const HttpBenchOptions& options, const std::string& sheet,
                            const std::filesystem::path& folder) {
    const std::string image = "/api/v1/sheets/" + sheet +
                              "/cells/A1/image.png?width=" + std::to_string(options.width) +
                              "&height=" + std::to_string(options.height);
    const auto always = [](const std::string& path) { return [path](int) { return path; }; };
    return {
        {"health", always("/livez")},
        {"api", always("/api/v1")},
        {"files", always("/api/v1/files?path=" + folder.string())},
        {"image_cached", always(image)},
        // An angle that no request before had.
        {"image_drawn", [image](int n) { return image + "&camera.azimuth=" + std::to_string(0.001 * n); }}};
}

} // namespace

nlohmann::json runHttpBench(const HttpBenchOptions& options) {
    const bench::ScratchFolder scratch;
    const ServedVolumes served(1, options.dim, options.device, scratch.path());
    if (!served.engine().waitIdle(120.0)) throw IoError("bench http", "no volume came within 120 s");
    nlohmann::json result{{"bench", "http"}, {"dim", options.dim}, {"size", {options.width, options.height}}};
    result["cases"] = nlohmann::json::array();
    std::atomic<int> next{1};
    for (const auto& route :
         routesOf(options, served.engine().snapshot()->sheets.front().name, scratch.path()))
        for (const int clients : options.clients)
            result["cases"].push_back(runCase(options, served.port(), route, clients, next));
    return result;
}

} // namespace voxsheet::cli
