// bench_arrival: how smoothly a sheet moves while its volumes arrive from disk, as one JSON object.
#include "bench/arrival_bench.h"
#include "bench/bench_options.h"

int main(int count, char** arguments) {
    using namespace voxsheet::bench;
    return runBenchProgram(
        count, arguments, "bench_arrival [OPTIONS] --json",
        [](const VolumeBenchOptions& options) { return arrivalBench(options, tellProgress); });
}
