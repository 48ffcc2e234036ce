#include "cli/bench/time_n_command.h"

#include "bench/time_n/time_n_arguments.h"
#include "bench/time_n/time_n_comparison.h"
#include "bench/time_n/time_n_output.h"
#include "cli/exit_codes.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <memory>

namespace voxsheet::cli {

namespace {

const char* const kAbout =
    "Draws N datasets in equal tiles for N = 1, 2, ... and reports T_N, the time from state to host pixels\n"
    "(the median of some frames with a turning camera, with its confidence interval), at the level of\n"
    "detail that --dr chooses. The datasets differ; they are written below TMPDIR (about 1.15 bytes per\n"
    "voxel) and removed at the end. What does not fit --texture-budget is uploaded again, what does not\n"
    "fit --memory-budget is read from the disk again.\n"
    "n_max is the largest N up to which every sheet was drawn whole and the time-N curve kept the rule\n"
    "R <= 1.5: no bend that is surely above 1.5 and that --dr did not answer with a coarser level.";

struct TimeNArguments {
    bench::TimeNOptions options;
    bench::TimeNTexts texts;
    bench::TimeNFiles files;
    std::string figuresFolder;
    bool json = false;
};

void printTable(const bench::TimeNResult& result) {
    std::printf("%4s %5s %10s %10s %10s %10s %10s %7s %7s\n", "N", "level", "ms", "low", "high", "upload",
                "reading", "R raw", "R");
    for (const auto& point : result.points)
        std::printf("%4d %5d %10.1f %10.1f %10.1f %10.1f %10.1f %7.2f %7.2f\n", point.n, point.level,
                    point.ms.value, point.ms.low, point.ms.high, point.uploadMs, point.ioMs,
                    point.rawRatio.value_or(std::nan("")), point.ratio ? point.ratio->value : std::nan(""));
    for (const auto& transition : result.transitions) {
        if (!bench::goesOnSteeper(transition)) continue;
        std::printf("after N = %d the slope is R = %.2f (%.2f to %.2f) times what it was, at level %d (%s)\n",
                    transition.bend.lastN, transition.bend.ratio.value, transition.bend.ratio.low,
                    transition.bend.ratio.high, transition.level, transition.cause.c_str());
    }
    for (const auto& sentence : bench::absentRegimes(result))
        std::printf("%s\n", sentence.c_str());
    std::printf("n_max %d\n", result.nMax);
}

int report(const std::vector<bench::TimeNResult>& results) {
    int exitCode = kExitDone;
    for (const auto& result : results)
        if (const auto complaint = bench::timerComplaint(result); !complaint.empty())
            exitCode = reportFailure(complaint);
    return exitCode;
}

int run(const TimeNArguments& arguments, const bench::Progress& progress) {
    const auto runs = bench::withTexts(arguments.options, arguments.texts);
    const bool figures = !arguments.figuresFolder.empty();
    const auto results = figures ? bench::runPaperFigures(runs.front(), bench::criteriaOf(arguments.texts),
                                                          arguments.figuresFolder, progress)
                                 : bench::runTimeN(runs, arguments.files, progress);
    if (arguments.json) {
        std::printf("%s\n", nlohmann::json::parse(bench::jsonOf(results)).dump(2).c_str());
        return report(results);
    }
    if (!figures)
        for (const auto& result : results)
            printTable(result);
    if (results.size() > 1) std::printf("%s", bench::summaryTable(results).c_str());
    if (figures) std::printf("the figures, and all else, are in %s\n", arguments.figuresFolder.c_str());
    return report(results);
}

} // namespace

Action addTimeN(CLI::App& app) {
    auto a = std::make_shared<TimeNArguments>();
    app.description(kAbout);
    app.footer(
        "Example: voxsheet bench time-n --technique vr --dr slope --json --csv vr.csv --svg vr.svg\n"
        "         voxsheet bench time-n --technique ie --dr off,slope --svg ie.svg    (both in one figure)\n"
        "         voxsheet bench time-n --figures figures --step 4      (the paper's figures 6 to 8)");
    app.add_option(
           "--technique", a->options.scene.technique,
           "vr (volume rendering), sr (surface rendering of box and cut), vc (voxelized clipping), ie "
           "(isosurface extraction)")
        ->check(CLI::IsMember({"vr", "sr", "vc", "ie"}));
    app.add_flag("--shading", a->options.scene.shading, "Phong, with a gradient texture for each volume");
    app.add_option("--max-n", a->options.maxN, "The largest N (64)")->check(CLI::Range(1, 1024));
    app.add_option("--dim", a->options.dim, "Samples per edge of each volume (256)")
        ->check(CLI::Range(16, 1024));
    app.add_option("--tile", a->texts.tile, "Pixels of each tile (256x256)");
    app.add_option("--texture-budget", a->texts.textureBudget, "Bytes of textures, e.g. 1G (256M)");
    app.add_option("--memory-budget", a->texts.memoryBudget,
                   "Bytes of volumes in host memory, e.g. 2G (512M)");
    app.add_option(
        "--dr", a->texts.dr,
        "Dynamic resolution: off; slope (R > 1.5), slope-first (R > 1.2, catches the paper's first "
        "transition too), time, rate, count, bytes; several with commas (off,slope) are a run each over "
        "the same datasets, in one figure, with the largest N of each (off; with --figures off,slope)");
    app.add_option(
        "--dr-limit", a->texts.drLimit,
        "For --dr time: ms (1000), rate: frames/s (1), count: datasets (25), bytes: of level 0 (1073741824)");
    app.add_option("--frames", a->options.frames,
                   "Frames per N and visit, of which the median counts (2); several times as many where they "
                   "are quick")
        ->check(CLI::Range(1, 1000));
    app.add_option("--visits", a->options.visits, "Visits of each N, at different times (3)")
        ->check(CLI::Range(1, 100));
    app.add_option("--step", a->options.step, "Measure every STEP-th N, more of those below it (1)")
        ->check(CLI::Range(1, 1024));
    app.add_option("--stop-ms", a->options.stopMs, "End the series at the first frame that takes longer");
    app.add_option("--device", a->options.device, "EGL device to draw on");
    app.add_option("--csv", a->files.csv, "Write the points here");
    app.add_option("--svg", a->files.svg, "Draw the curve here");
    app.add_option(
        "--figures", a->figuresFolder,
        "All techniques, with and without shading, without dynamic resolution and with the slope rule: "
        "writes figures 6, 7, 8a, 8b, every run's figure, points and JSON, and a summary into this folder; "
        "with --dr slope 8a and 8b only, with --dr off 6 and 7");
    app.add_flag("--json", a->json, "One JSON object on stdout instead of a table");
    return [a] {
        const auto progress = [](const std::string& text) {
            std::fprintf(stderr, "bench time-n: %s\n", text.c_str());
        };
        return run(*a, progress);
    };
}

} // namespace voxsheet::cli
