#include "cli/level_arguments.h"

#include "base/byte_size.h"
#include "base/errors.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdlib>

namespace voxsheet::cli {

namespace {

double positiveNumber(const std::string& text, const char* what) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !std::isfinite(value) || value <= 0.0)
        throw InvalidInput("--dr-limit", "`" + text + "` is no number of " + what + " above 0")
            .withField("--dr-limit");
    return value;
}

int datasetCount(const std::string& text) {
    const double value = positiveNumber(text, "datasets");
    if (value < 1.0 || value > 1e6 || value != std::floor(value))
        throw InvalidInput("--dr-limit", "`" + text + "` is no whole number of datasets")
            .withField("--dr-limit");
    return static_cast<int>(value);
}

} // namespace

void addLevelArguments(CLI::App& app, LevelArguments& arguments) {
    app.add_option(
           "--dr", arguments.policy,
           "How levels of detail are chosen: focus (a level per cell, from its size on the screen and "
           "what is looked at), or one level for all cells by slope, slope-first, time, rate, count, "
           "bytes, or off")
        ->check(CLI::IsMember(levelPolicyNames()))
        ->capture_default_str();
    app.add_option("--dr-limit", arguments.limit,
                   "Limit of --dr: ms per frame at rest (focus, time), frames per second (rate), datasets "
                   "(count), or bytes such as 512M (bytes)");
}

LevelSettings levelSettings(const LevelArguments& arguments) {
    LevelSettings settings;
    settings.policy = levelPolicyFromName(arguments.policy);
    if (arguments.limit.empty()) return settings;
    switch (settings.policy) {
    case LevelPolicy::Focus:
    case LevelPolicy::Time:
        settings.frameMs = positiveNumber(arguments.limit, "milliseconds");
        break;
    case LevelPolicy::Rate:
        settings.framesPerSecond = positiveNumber(arguments.limit, "frames per second");
        break;
    case LevelPolicy::Count:
        settings.datasets = datasetCount(arguments.limit);
        break;
    case LevelPolicy::Bytes:
        settings.bytes = parseBytes(arguments.limit, "--dr-limit");
        break;
    case LevelPolicy::Off:
    case LevelPolicy::Slope:
    case LevelPolicy::SlopeFirst:
        throw InvalidInput("--dr-limit", "--dr " + arguments.policy + " has no limit",
                           "leave it out, or choose focus, time, rate, count or bytes")
            .withField("--dr-limit");
    }
    return settings;
}

} // namespace voxsheet::cli
