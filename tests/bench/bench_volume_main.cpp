// bench_volume: times and quality of the volume rendering techniques, as one JSON object.
#include "bench/bench_options.h"
#include "bench/inside_bench.h"

int main(int count, char** arguments) {
    using namespace voxsheet::bench;
    return runBenchProgram(count, arguments, "bench_volume [OPTIONS] --json",
                           [](const VolumeBenchOptions& options) {
                               return options.techniques.empty() ? volumeBench(options, tellProgress)
                                                                 : insideBench(options, tellProgress);
                           });
}
