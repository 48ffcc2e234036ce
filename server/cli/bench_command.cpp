#include "base/errors.h"
#include "bench/inside_bench.h"
#include "bench/volume_bench.h"
#include "cli/bench/calibrate_command.h"
#include "cli/bench/cases_table.h"
#include "cli/bench/edit_bench.h"
#include "cli/bench/edit_to_pixels_bench.h"
#include "cli/bench/http_bench.h"
#include "cli/bench/import_bench.h"
#include "cli/bench/stream_bench.h"
#include "cli/bench/time_n_command.h"
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/thread_arguments.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace voxsheet::cli {

namespace {

Action withOutput(CLI::App& app, std::function<nlohmann::json()> run) {
    auto json = std::make_shared<bool>(false);
    app.add_flag("--json", *json, "One JSON object on stdout instead of a table");
    return [json, run = std::move(run)] {
        const auto result = run();
        if (*json)
            std::printf("%s\n", result.dump(2).c_str());
        else
            std::fputs(casesTable(result.at("cases")).c_str(), stdout);
        return kExitDone;
    };
}

Action addStream(CLI::App& app) {
    auto options = std::make_shared<StreamBenchOptions>();
    app.add_option("--cells", options->cells, "Numbers of cells")->delimiter(',')->check(CLI::Range(1, 256));
    app.add_option("--dim", options->dim, "Samples per edge of each volume")->check(CLI::Range(16, 512));
    app.add_option("--width", options->width, "Width of the sheet in pixels")->check(CLI::Range(64, 8192));
    app.add_option("--height", options->height, "Height of the sheet in pixels")->check(CLI::Range(64, 8192));
    app.add_option("--seconds", options->seconds, "Time of dragging per case")->check(CLI::Range(0.5, 600.0));
    app.add_option("--device", options->device, "EGL device to draw on");
    app.add_option("--keep", options->keep,
                   "Folder that keeps the volumes and what is made of them for the next run");
    return withOutput(app, [options] { return runStreamBench(*options); });
}

Action addHttp(CLI::App& app) {
    auto options = std::make_shared<HttpBenchOptions>();
    app.add_option("--clients", options->clients, "Numbers of clients that ask at the same time")
        ->delimiter(',')
        ->check(CLI::Range(1, 512));
    app.add_option("--seconds", options->seconds, "Time of asking per case")->check(CLI::Range(0.05, 600.0));
    app.add_option("--dim", options->dim, "Samples per edge of the volume")->check(CLI::Range(16, 512));
    app.add_option("--width", options->width, "Width of the pictures in pixels")->check(CLI::Range(16, 4096));
    app.add_option("--height", options->height, "Height of the pictures in pixels")
        ->check(CLI::Range(16, 4096));
    app.add_option("--device", options->device, "EGL device to draw on");
    app.footer("Example: voxsheet bench http --clients 1,4,16 --json");
    return withOutput(app, [options] { return runHttpBench(*options); });
}

Action addEdit(CLI::App& app) {
    auto options = std::make_shared<EditBenchOptions>();
    app.add_option("--cells", options->cells, "Number of cells (25)")->check(CLI::Range(1, 256));
    app.add_option("--dim", options->dim, "Samples per edge of each volume (128)")
        ->check(CLI::Range(16, 512));
    app.add_option("--width", options->width, "Width of each tile in pixels (256)")
        ->check(CLI::Range(16, 4096));
    app.add_option("--height", options->height, "Height of each tile in pixels (256)")
        ->check(CLI::Range(16, 4096));
    app.add_option("--repeats", options->repeats, "Edits of either kind, of which the median counts (21)")
        ->check(CLI::Range(1, 10000));
    app.add_option("--device", options->device, "EGL device to draw on");
    app.footer("Example: voxsheet bench edit --json");
    return withOutput(app, [options] { return runEditBench(*options); });
}

Action addEditToPixels(CLI::App& app) {
    auto options = std::make_shared<EditToPixelsOptions>();
    app.add_option("--cells", options->cells, "Number of cells (9)")->check(CLI::Range(1, 256));
    app.add_option("--dim", options->dim, "Samples per edge of each volume (128)")
        ->check(CLI::Range(16, 512));
    app.add_option("--width", options->width, "Width of the sheet in pixels (768)")
        ->check(CLI::Range(64, 8192));
    app.add_option("--height", options->height, "Height of the sheet in pixels (768)")
        ->check(CLI::Range(64, 8192));
    app.add_option("--edits", options->edits, "Edits of each kind that count (40)")
        ->check(CLI::Range(1, 10000));
    app.add_option("--device", options->device, "EGL device to draw on");
    app.footer("Example: voxsheet bench edit-to-pixels --json");
    return withOutput(app, [options] { return runEditToPixelsBench(*options); });
}

Action addImport(CLI::App& app) {
    auto options = std::make_shared<ImportBenchOptions>();
    app.add_option("--dim", options->dim, "Samples per edge of each file (192)")->check(CLI::Range(8, 512));
    app.add_option("--repeats", options->repeats, "Readings of each file, of which the fastest counts (3)")
        ->check(CLI::Range(1, 100));
    app.add_option("--only", options->only, "Only formats whose name has this text in it");
    app.add_option("--files", options->files,
                   "Numbers of files for the time to the first picture (1,40); 0: none")
        ->delimiter(',')
        ->check(CLI::Range(0, 256));
    app.add_option("--file-dim", options->fileDim, "Samples per edge of those files (256)")
        ->check(CLI::Range(8, 512));
    app.add_option("--device", options->device, "EGL device to draw on");
    app.footer("Example: voxsheet bench import --only chgcar --json");
    return withOutput(app, [options] {
        return runImportBench(*options, [](const std::string& name) {
            std::fprintf(stderr, "bench import: %s\n", name.c_str());
        });
    });
}

Action addVolume(CLI::App& app) {
    auto options = std::make_shared<bench::VolumeBenchOptions>();
    auto type = std::make_shared<std::string>("u8");
    auto* samples = app.add_option("--samples", options->samples, "Samples per edge of the volume")
                        ->check(CLI::Range(16, 1024));
    app.add_option("--technique", options->techniques,
                   "What looks inside, with and without light, at 128 and 256 samples: vr (volume), sr "
                   "(surface), vc (clip "
                   "object), ie (isosurface), all")
        ->delimiter(',')
        ->check(CLI::IsMember({"vr", "sr", "vc", "ie", "all"}));
    app.add_option("--only", options->only, "Of --technique, the cases whose name has this text in it");
    app.add_option("--pixels", options->pixels, "Edge of the square picture")->check(CLI::Range(16, 4096));
    app.add_option("--frames", options->frames, "Frames per case, of which the median counts")
        ->check(CLI::Range(1, 10000));
    app.add_option("--type", *type, "Type of the samples")->check(CLI::IsMember({"u8", "u16", "f32"}));
    app.add_option("--device", options->device, "EGL device to draw on");
    return withOutput(app, [options, type, samples] {
        options->type = scalarFromName(*type).value();
        options->samplesGiven = samples->count() > 0;
        const auto progress = [](const std::string& name) {
            std::fprintf(stderr, "bench volume: %s\n", name.c_str());
        };
        return nlohmann::json::parse(options->techniques.empty() ? bench::volumeBench(*options, progress)
                                                                 : bench::insideBench(*options, progress));
    });
}

Action addCalibrate(CLI::App& app) {
    auto options = std::make_shared<bench::CalibrateOptions>();
    auto forget = std::make_shared<bool>(false);
    app.add_option("--dim", options->samples, "Samples per edge of the volume (128)")
        ->check(CLI::Range(16, 1024));
    app.add_option("--pixels", options->pixels, "Edge of the square picture (384)")
        ->check(CLI::Range(16, 4096));
    app.add_option("--frames", options->frames, "Frames per path, of which the median counts (15)")
        ->check(CLI::Range(1, 10000));
    app.add_option("--device", options->device, "EGL device to draw on");
    app.add_flag("--forget", *forget, "Remove what is remembered of this device instead");
    addThreadArgument(app);
    app.footer("Example: voxsheet bench calibrate --json");
    return withOutput(app, [options, forget] {
        return *forget ? forgetCalibration(options->device) : runCalibration(*options);
    });
}

} // namespace

Action addBench(CLI::App& app) {
    app.require_subcommand(1);
    app.footer("Example: voxsheet bench stream --cells 1,9,25 --json");
    struct Bench {
        CLI::App* app;
        Action action;
    };
    auto benches = std::make_shared<std::vector<Bench>>();
    const auto add = [&](const char* name, const char* text, Action (*define)(CLI::App&)) {
        auto* bench = app.add_subcommand(name, text);
        benches->push_back({bench, define(*bench)});
    };
    add("volume", "Time and quality of every volume rendering technique on one volume", &addVolume);
    add("stream", "Input-to-pixels latency, frames per second and bytes per frame over loopback", &addStream);
    add("import", "Reading of every format against plain reading or decompression; time to the first picture",
        &addImport);
    add("edit", "Time from an edit to the final pictures: one dirty cell against a whole dirty sheet",
        &addEdit);
    add("edit-to-pixels",
        "Time from an edit of each kind to the first pictures on a page, and to the final ones",
        &addEditToPixels);
    add("calibrate", "Find the fastest path of each technique on this device, and remember it",
        &addCalibrate);
    add("http", "Requests per second and their latency over loopback", &addHttp);
    add("time-n", "Rendering time over the number of datasets, with dynamic resolution or without",
        &addTimeN);
    return [benches] {
        for (const auto& bench : *benches)
            if (bench.app->parsed()) return bench.action();
        return kExitUsage;
    };
}

} // namespace voxsheet::cli
