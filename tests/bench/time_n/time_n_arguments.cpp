#include "bench/time_n/time_n_arguments.h"

#include "base/byte_size.h"
#include "base/errors.h"

#include <cmath>
#include <cstdio>

namespace voxsheet::bench {

namespace {

void setLimit(ResolutionRule& rule, double limit) {
    if (!std::isfinite(limit) || limit <= 0.0)
        throw InvalidInput("--dr-limit", "it must be above 0").withField("dr-limit");
    switch (rule.criterion) {
    case ResolutionCriterion::Time:
        rule.frameMs = limit;
        return;
    case ResolutionCriterion::Rate:
        rule.framesPerSecond = limit;
        return;
    case ResolutionCriterion::Count:
        rule.datasets = static_cast<int>(std::min(limit, 1e6));
        return;
    case ResolutionCriterion::Bytes:
        rule.bytes = static_cast<std::uint64_t>(std::min(limit, 0x1p60));
        return;
    case ResolutionCriterion::Off:
    case ResolutionCriterion::Slope:
    case ResolutionCriterion::SlopeFirst:
        break;
    }
    throw InvalidInput("--dr-limit",
                       "--dr " + std::string(resolutionCriterionName(rule.criterion)) + " has none",
                       "it belongs to --dr time, rate, count or bytes")
        .withField("dr-limit");
}

} // namespace

glm::ivec2 parseTileSize(const std::string& text) {
    int width = 0;
    int height = 0;
    int used = 0;
    const int length = static_cast<int>(text.size());
    if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 &&
        std::sscanf(text.c_str(), "%d%n", &width, &used) == 1)
        height = width;
    if (used != length || width < 8 || height < 8 || width > 4096 || height > 4096)
        throw InvalidInput("--tile", "`" + text + "` is no size of 8 to 4096 pixels",
                           "write for example 256x256")
            .withField("tile");
    return {width, height};
}

TimeNOptions withTexts(TimeNOptions options, const TimeNTexts& texts) {
    options.scene.tilePixels = parseTileSize(texts.tile);
    options.textureBudgetBytes = parseBytes(texts.textureBudget, "--texture-budget");
    options.memoryBudgetBytes = parseBytes(texts.memoryBudget, "--memory-budget");
    const auto criterion = resolutionCriterionFromName(texts.dr);
    if (!criterion)
        throw InvalidInput("--dr",
                           "`" + texts.dr + "` is none of off, slope, slope-first, time, rate, count, bytes")
            .withField("dr");
    options.rule.criterion = *criterion;
    if (texts.drLimit) setLimit(options.rule, *texts.drLimit);
    return options;
}

} // namespace voxsheet::bench
