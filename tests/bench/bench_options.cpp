#include "bench/bench_options.h"

#include "base/errors.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace voxsheet::bench {
namespace {

int numberAfter(int count, char** arguments, int& index, int low, int high) {
    const std::string name = arguments[index];
    if (index + 1 >= count) throw InvalidInput(name, "its number is missing");
    char* end = nullptr;
    const long number = std::strtol(arguments[++index], &end, 10);
    if (*end != '\0' || end == arguments[index] || number < low || number > high)
        throw InvalidInput(name, std::string("\"") + arguments[index] + "\" is not a whole number from " +
                                     std::to_string(low) + " to " + std::to_string(high));
    return static_cast<int>(number);
}

ScalarType typeAfter(int count, char** arguments, int& index) {
    const auto type = index + 1 < count ? scalarFromName(arguments[index + 1]) : std::nullopt;
    if (type != ScalarType::U8 && type != ScalarType::U16 && type != ScalarType::F32)
        throw InvalidInput("--type", "it is not u8, u16 or f32");
    ++index;
    return *type;
}

bool samplingAfter(int count, char** arguments, int& index) {
    const std::string word = index + 1 < count ? arguments[index + 1] : "";
    if (word != "adaptive" && word != "even") throw InvalidInput("--sampling", "it is not adaptive or even");
    ++index;
    return word == "adaptive";
}

} // namespace

std::optional<VolumeBenchOptions> parseOptions(int count, char** arguments, const std::string& usage) {
    VolumeBenchOptions options;
    for (int i = 1; i < count; ++i) {
        const std::string argument = arguments[i];
        if (argument == "--help") {
            std::printf(
                "%s\n  --samples N  of the volume per axis (256)\n  --pixels N   of the square "
                "picture (512)\n"
                "  --cell-samples N  per axis of each of 25 cells (128)\n"
                "  --frames N   per case (20)\n  --device N   EGL device\n  --type T     u8, u16 or "
                "f32 (u8)\n"
                "  --technique T  vr, sr, vc, ie or all: what looks inside, with and without light, at 128 "
                "and 256 samples\n"
                "  --sampling S   adaptive or even (adaptive)\n"
                "  --scans FOLDER  (bench_vs_vtk) the real scans of the test data instead\n"
                "  --only TEXT  cases with this in their names\n"
                "  --large      against VTK: volumes of 512^3, u8 and u16, at 1024x1024, too; alone with "
                "--only "
                "512^3\n"
                "  --json       one JSON object on stdout (always so)\n",
                usage.c_str());
            return std::nullopt;
        }
        if (argument == "--samples")
            options.samples = numberAfter(count, arguments, i, 8, 1024), options.samplesGiven = true;
        else if (argument == "--cell-samples")
            options.cellSamples = numberAfter(count, arguments, i, 8, 512);
        else if (argument == "--pixels")
            options.pixels = numberAfter(count, arguments, i, 8, 4096);
        else if (argument == "--frames")
            options.frames = numberAfter(count, arguments, i, 1, 10000);
        else if (argument == "--device")
            options.device = numberAfter(count, arguments, i, 0, 64);
        else if (argument == "--type")
            options.type = typeAfter(count, arguments, i);
        else if (argument == "--technique" && i + 1 < count)
            options.techniques.emplace_back(arguments[++i]);
        else if (argument == "--sampling")
            options.adaptive = samplingAfter(count, arguments, i);
        else if (argument == "--only" && i + 1 < count)
            options.only = arguments[++i];
        else if (argument == "--large")
            options.large = true;
        else if (argument == "--scans" && i + 1 < count)
            options.scans = arguments[++i];
        else if (argument != "--json")
            throw InvalidInput(argument, "there is no such option", "see --help");
    }
    return options;
}

int runBenchProgram(int count, char** arguments, const std::string& usage,
                    const std::function<std::string(const VolumeBenchOptions&)>& bench) {
    std::optional<VolumeBenchOptions> options;
    try {
        options = parseOptions(count, arguments, usage);
    } catch (const InvalidInput& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 2;
    }
    if (!options) return 0;
    try {
        std::printf("%s\n", bench(*options).c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
    return 0;
}

bool isWanted(const VolumeBenchOptions& options, const std::string& name) {
    return name.find(options.only) != std::string::npos;
}

void tellProgress(const std::string& name) { std::fprintf(stderr, "%s\n", name.c_str()); }

} // namespace voxsheet::bench
