// bench_time_n: rendering time over the number of datasets, as one JSON object; needs no server.
#include "base/errors.h"
#include "bench/time_n/time_n_arguments.h"
#include "bench/time_n/time_n_output.h"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>

namespace voxsheet::bench {
namespace {

const char* const kUsage =
    "bench_time_n [OPTIONS]    (as `voxsheet bench time-n --json`; its --help explains them)\n"
    "  --technique vr|sr|vc|ie   --shading   --max-n N (64)   --dim N (256)   --tile WxH (256x256)\n"
    "  --texture-budget BYTES (256M)   --memory-budget BYTES (512M)\n"
    "  --dr off|slope|slope-first|time|rate|count|bytes (or several: off,slope)   --dr-limit X\n"
    "  --frames N (2)   --visits N (3)   --step N (1)   --stop-ms MS   --device N   --csv FILE   --svg FILE  "
    " --figures "
    "FOLDER   --json\n";

struct Arguments {
    TimeNOptions options;
    TimeNTexts texts;
    TimeNFiles files;
    std::string figuresFolder;
    std::vector<TimeNOptions> runs;
    bool help = false;
};

double numberOf(const std::string& name, const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') throw InvalidInput(name, "`" + text + "` is no number");
    return number;
}

int wholeNumberOf(const std::string& name, const std::string& text) {
    const double number = numberOf(name, text);
    if (number < 0.0 || number > 1e6 || number != static_cast<int>(number))
        throw InvalidInput(name, "`" + text + "` is no whole number in range");
    return static_cast<int>(number);
}

Arguments parse(int count, char** words) {
    Arguments a;
    std::string name;
    using Take = std::function<void(const std::string&)>;
    const auto text = [](auto& into) -> Take { return [&into](const std::string& word) { into = word; }; };
    const auto whole = [&name](int& into) -> Take {
        return [&](const std::string& word) { into = wholeNumberOf(name, word); };
    };
    const std::map<std::string, Take> options{
        {"--technique", text(a.options.scene.technique)},
        {"--tile", text(a.texts.tile)},
        {"--texture-budget", text(a.texts.textureBudget)},
        {"--memory-budget", text(a.texts.memoryBudget)},
        {"--dr", text(a.texts.dr)},
        {"--csv", text(a.files.csv)},
        {"--svg", text(a.files.svg)},
        {"--figures", text(a.figuresFolder)},
        {"--max-n", whole(a.options.maxN)},
        {"--dim", whole(a.options.dim)},
        {"--frames", whole(a.options.frames)},
        {"--visits", whole(a.options.visits)},
        {"--step", whole(a.options.step)},
        {"--device", whole(a.options.device)},
        {"--dr-limit", [&](const std::string& word) { a.texts.drLimit = numberOf(name, word); }},
        {"--stop-ms", [&](const std::string& word) { a.options.stopMs = numberOf(name, word); }}};
    for (int i = 1; i < count; ++i) {
        name = words[i];
        if (name == "--help") a.help = true;
        if (name == "--shading") a.options.scene.shading = true;
        if (name == "--help" || name == "--shading" || name == "--json") continue;
        const auto known = options.find(name);
        if (known == options.end()) throw InvalidInput(name, "there is no such option", "see --help");
        if (++i == count) throw InvalidInput(name, "its value is missing");
        known->second(words[i]);
    }
    a.runs = withTexts(a.options, a.texts);
    return a;
}

int run(const Arguments& arguments) {
    const auto progress = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
    const auto results = arguments.figuresFolder.empty()
                             ? runTimeN(arguments.runs, arguments.files, progress)
                             : runPaperFigures(arguments.runs.front(), criteriaOf(arguments.texts),
                                               arguments.figuresFolder, progress);
    std::printf("%s\n", jsonOf(results).c_str());
    int exitCode = 0;
    for (const auto& result : results)
        if (const auto complaint = timerComplaint(result); !complaint.empty()) {
            std::fprintf(stderr, "error: %s\n", complaint.c_str());
            exitCode = 1;
        }
    return exitCode;
}

} // namespace
} // namespace voxsheet::bench

int main(int count, char** words) {
    using namespace voxsheet;
    try {
        const auto arguments = bench::parse(count, words);
        if (!arguments.help) return bench::run(arguments);
        std::printf("%s", bench::kUsage);
        return 0;
    } catch (const InvalidInput& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
