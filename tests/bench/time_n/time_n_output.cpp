#include "bench/time_n/time_n_output.h"

#include "base/errors.h"
#include "bench/json_text.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/stop_signals.h"
#include "bench/time_n/time_n_bench.h"
#include "bench/time_n/time_n_comparison.h"
#include "bench/time_n/time_n_figure.h"

#include <algorithm>
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

/// \param runs  all that will be drawn; they differ in scene and rule only
BenchDatasets datasetsFor(std::span<const TimeNOptions> runs, const Progress& progress) {
    const auto& options = runs.front();
    for (const auto& run : runs)
        validateOptions(run);
    {
        const BenchDatasets one(1, options.dim, [](int) { throwIfStopRequested(); });
        for (const auto& run : runs)
            rehearse(run, one);
    }
    return BenchDatasets(options.maxN, options.dim, [&](int count) {
        throwIfStopRequested();
        if (count % 16 == 0 || count == options.maxN)
            progress("wrote " + std::to_string(count) + " of " + std::to_string(options.maxN) + " datasets");
    });
}

TimeNResult measure(const TimeNOptions& options, const BenchDatasets& datasets, const Progress& progress) {
    auto result = timeNBench(options, datasets, progress);
    for (const auto& sentence : absentRegimes(result))
        progress(sentence);
    if (const auto busy = busyMachine(result); !busy.empty()) progress(busy);
    return result;
}

std::string figureOf(std::span<const TimeNResult> results) {
    const auto comparison = comparisonsOf(results).front();
    if (comparison.without == nullptr || comparison.with == nullptr) return timeNFigure(results.front());
    return comparisonFigure(*comparison.without, *comparison.with);
}

constexpr int kLowN = 10; ///< where the paper's insets end

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

std::vector<TimeNResult> runTimeN(const std::vector<TimeNOptions>& runs, const TimeNFiles& files,
                                  const Progress& progress) {
    const StopSignals signals;
    for (const auto& file : {files.csv, files.svg})
        if (!file.empty()) write(file, {});
    const auto datasets = datasetsFor(runs, progress);
    std::vector<TimeNResult> results;
    for (const auto& options : runs) {
        if (runs.size() > 1) progress(std::string("--dr ") + resolutionCriterionName(options.rule.criterion));
        results.push_back(measure(options, datasets, progress));
    }
    if (!files.csv.empty()) write(files.csv, csvOf(results));
    if (!files.svg.empty()) write(files.svg, figureOf(results));
    return results;
}

namespace {

std::vector<TimeNOptions> runsOf(const PaperFigure& figure, TimeNOptions options) {
    options.scene.shading = figure.shading;
    options.rule.criterion = figure.criterion;
    std::vector<TimeNOptions> runs;
    for (const char* technique : {"vr", "sr", "vc", "ie"}) {
        options.scene.technique = technique;
        runs.push_back(options);
    }
    return runs;
}

/// Of the paper's figures those that are drawn by one of `criteria`.
std::vector<PaperFigure> figuresBy(std::span<const ResolutionCriterion> criteria) {
    std::vector<PaperFigure> chosen;
    for (const auto& figure : kPaperFigures)
        if (criteria.empty() || std::count(criteria.begin(), criteria.end(), figure.criterion) > 0)
            chosen.push_back(figure);
    for (const auto criterion : criteria)
        if (criterion != ResolutionCriterion::Off && criterion != ResolutionCriterion::Slope)
            throw InvalidInput("--dr",
                               std::string("none of the figures 6 to 8 is drawn by ") +
                                   resolutionCriterionName(criterion),
                               "with --figures, give off, slope or both")
                .withField("--dr");
    return chosen;
}

void writeRun(const fs::path& folder, const std::string& name, const TimeNResult& result) {
    write(folder / (name + ".csv"), csvOf({&result, 1}));
    write(folder / (name + ".svg"), timeNFigure(result));
    write(folder / (name + ".json"), jsonOf(result) + "\n");
}

void writeSummary(const fs::path& folder, std::span<const TimeNResult> results) {
    write(folder / "times.csv", csvOf(results));
    write(folder / "summary.md", summaryTable(results));
    for (const auto& each : comparisonsOf(results))
        if (each.without != nullptr && each.with != nullptr)
            write(folder / (each.technique + (each.shading ? "-shading" : "") + ".svg"),
                  comparisonFigure(*each.without, *each.with));
}

} // namespace

std::vector<TimeNResult> runPaperFigures(const TimeNOptions& options,
                                         std::span<const ResolutionCriterion> criteria,
                                         const fs::path& folder, const Progress& progress) {
    const auto figures = figuresBy(criteria);
    const StopSignals signals;
    fs::create_directories(folder);
    std::vector<TimeNOptions> runs;
    for (const auto& figure : figures)
        for (const auto& run : runsOf(figure, options))
            runs.push_back(run);
    const auto datasets = datasetsFor(runs, progress);
    std::vector<TimeNResult> all;
    all.reserve(runs.size());
    for (const auto& figure : figures) {
        const auto first = all.size();
        for (const auto& run : runsOf(figure, options)) {
            const auto name = std::string(figure.name) + "-" + run.scene.technique;
            progress(name);
            all.push_back(measure(run, datasets, progress));
            writeRun(folder, name, all.back());
            writeSummary(folder, all); // what is there counts when the rest is interrupted
        }
        const auto results = std::span(all).subspan(first);
        const std::string title = figure.title;
        write(folder / (std::string(figure.name) + ".svg"), techniquesFigure(results, title, options.maxN));
        if (options.maxN > kLowN)
            write(folder / (std::string(figure.name) + "-low-n.svg"),
                  techniquesFigure(results, title + ", low N", kLowN));
    }
    return all;
}

std::string jsonOf(const std::vector<TimeNResult>& results) {
    if (results.size() == 1) return jsonOf(results.front());
    std::vector<std::string> runs;
    for (const auto& result : results)
        runs.push_back(jsonOf(result));
    return jsonObject({{"runs", jsonArray(runs)}, {"summary", summaryJson(results)}});
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
