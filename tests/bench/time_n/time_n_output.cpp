#include "bench/time_n/time_n_output.h"

#include "base/errors.h"
#include "bench/json_text.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/stop_signals.h"
#include "bench/time_n/time_n_bench.h"
#include "bench/time_n/time_n_figure.h"

#include <cstdio>
#include <fstream>

namespace voxsheet::bench {

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush())
        throw IoError(file.string(), "it could not be written",
                      "name a file in a folder that you may write to");
}

BenchDatasets datasetsFor(const TimeNOptions& options, const Progress& progress) {
    validateOptions(options);
    return BenchDatasets(options.maxN, options.dim, [&](int count) {
        throwIfStopRequested();
        if (count % 16 == 0 || count == options.maxN)
            progress("wrote " + std::to_string(count) + " of " + std::to_string(options.maxN) + " datasets");
    });
}

TimeNResult measure(const TimeNOptions& options, const BenchDatasets& datasets, const TimeNFiles& files,
                    const Progress& progress) {
    auto result = timeNBench(options, datasets, progress);
    if (!files.csv.empty()) write(files.csv, csvOf(result));
    if (!files.svg.empty()) write(files.svg, timeNFigure(result));
    for (const auto& sentence : absentRegimes(result))
        progress(sentence);
    if (const auto busy = busyMachine(result); !busy.empty()) progress(busy);
    return result;
}

struct PaperFigure {
    const char* name;
    bool shading;
    ResolutionCriterion criterion;
    const char* title;
};

constexpr PaperFigure kPaperFigures[] = {
    {"figure-6", false, ResolutionCriterion::Off, "Without shading, without dynamic resolution (figure 6)"},
    {"figure-7", true, ResolutionCriterion::Off, "With shading, without dynamic resolution (figure 7)"},
    {"figure-8a", false, ResolutionCriterion::Slope,
     "Without shading, dynamic resolution by slope (figure 8a)"},
    {"figure-8b", true, ResolutionCriterion::Slope, "With shading, dynamic resolution by slope (figure 8b)"}};

} // namespace

TimeNResult runTimeN(const TimeNOptions& options, const TimeNFiles& files, const Progress& progress) {
    const StopSignals signals;
    for (const auto& file : {files.csv, files.svg})
        if (!file.empty()) write(file, {});
    const auto datasets = datasetsFor(options, progress);
    return measure(options, datasets, files, progress);
}

std::vector<TimeNResult> runPaperFigures(TimeNOptions options, const fs::path& folder,
                                         const Progress& progress) {
    const StopSignals signals;
    fs::create_directories(folder);
    const auto datasets = datasetsFor(options, progress);
    std::vector<TimeNResult> all;
    for (const auto& figure : kPaperFigures) {
        options.scene.shading = figure.shading;
        options.rule.criterion = figure.criterion;
        std::vector<TimeNResult> results;
        for (const char* technique : {"vr", "sr", "vc", "ie"}) {
            options.scene.technique = technique;
            const auto name = std::string(figure.name) + "-" + technique;
            progress(name);
            results.push_back(
                measure(options, datasets, {folder / (name + ".csv"), folder / (name + ".svg")}, progress));
            write(folder / (name + ".json"), jsonOf(results.back()) + "\n");
        }
        write(folder / (std::string(figure.name) + ".svg"), techniquesFigure(results, figure.title));
        all.insert(all.end(), results.begin(), results.end());
    }
    return all;
}

std::string jsonOf(const std::vector<TimeNResult>& results) {
    std::vector<std::string> runs;
    for (const auto& result : results)
        runs.push_back(jsonOf(result));
    return jsonObject({{"runs", jsonArray(runs)}});
}

std::string timerComplaint(const TimeNResult& result) {
    if (result.timersAgree) return {};
    return "the GPU's timestamps: they give " + jsonNumber(result.timerGpuMs) + " ms for tiles that took " +
           jsonNumber(result.timerHostMs) +
           " ms by the host's clock, more than 10 % apart; measure again on a machine that is less busy, or "
           "do "
           "not trust this driver's timer";
}

} // namespace voxsheet::bench
