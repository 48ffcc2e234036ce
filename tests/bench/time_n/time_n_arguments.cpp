#include "bench/time_n/time_n_arguments.h"

#include "base/byte_size.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace voxsheet::bench {

namespace {

/// False when the rule's criterion has no limit.
bool setLimit(ResolutionRule& rule, double limit) {
    if (!std::isfinite(limit) || limit <= 0.0)
        throw InvalidInput("--dr-limit", "it must be above 0").withField("--dr-limit");
    switch (rule.criterion) {
    case ResolutionCriterion::Time:
        rule.frameMs = limit;
        return true;
    case ResolutionCriterion::Rate:
        rule.framesPerSecond = limit;
        return true;
    case ResolutionCriterion::Count:
        rule.datasets = static_cast<int>(std::clamp(limit, 1.0, 1e6));
        return true;
    case ResolutionCriterion::Bytes:
        rule.bytes = static_cast<std::uint64_t>(std::clamp(limit, 1.0, 0x1p60));
        return true;
    case ResolutionCriterion::Off:
    case ResolutionCriterion::Slope:
    case ResolutionCriterion::SlopeFirst:
        break;
    }
    return false;
}

ResolutionCriterion criterionOf(const std::string& name) {
    if (const auto criterion = resolutionCriterionFromName(name)) return *criterion;
    throw InvalidInput("--dr", "`" + name + "` is none of off, slope, slope-first, time, rate, count, bytes",
                       "name one of them, or several with commas between them: off,slope")
        .withField("--dr");
}

std::vector<std::string> commaList(const std::string& text) {
    std::vector<std::string> items;
    std::istringstream in(text + ",");
    for (std::string item; std::getline(in, item, ',');)
        items.push_back(item);
    return items;
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
            .withField("--tile");
    return {width, height};
}

std::vector<ResolutionCriterion> criteriaOf(const TimeNTexts& texts) {
    std::vector<ResolutionCriterion> criteria;
    if (!texts.dr) return criteria;
    for (const auto& name : commaList(*texts.dr))
        criteria.push_back(criterionOf(name));
    return criteria;
}

std::vector<TimeNOptions> withTexts(const TimeNOptions& options, const TimeNTexts& texts) {
    TimeNOptions common = options;
    common.scene.tilePixels = parseTileSize(texts.tile);
    common.textureBudgetBytes = parseBytes(texts.textureBudget, "--texture-budget");
    common.memoryBudgetBytes = parseBytes(texts.memoryBudget, "--memory-budget");
    std::vector<TimeNOptions> runs;
    bool limitUsed = false;
    auto criteria = criteriaOf(texts);
    if (criteria.empty()) criteria = {ResolutionCriterion::Off};
    for (const auto criterion : criteria) {
        runs.push_back(common);
        runs.back().rule.criterion = criterion;
        if (texts.drLimit) limitUsed = setLimit(runs.back().rule, *texts.drLimit) || limitUsed;
    }
    if (texts.drLimit && !limitUsed)
        throw InvalidInput("--dr-limit", "--dr " + texts.dr.value_or("off") + " has none",
                           "it belongs to --dr time, rate, count or bytes")
            .withField("--dr-limit");
    return runs;
}

} // namespace voxsheet::bench
