#include "frame/path_choice.h"

#include "base/errors.h"

#include <algorithm>

namespace voxsheet {
namespace {

/// As tests/image/simd_rays_test.cpp.
constexpr double kUndecidedPixels = 2.0;
constexpr double kUndecidedPart = 0.004;
/// What is won by less is not worth another path than the one that all tests and users run.
constexpr double kClearWin = 1.05;

template <typename Values, typename NameOf>
std::string listed(const Values& values, NameOf nameOf) {
    std::string text;
    for (const auto value : values)
        text += (text.empty() ? "" : ", ") + std::string(nameOf(value));
    return text;
}

InvalidInput noSuchPath(const std::string& path, Technique technique) {
    return InvalidInput("--path",
                        std::string(techniqueName(technique)) + " has no path `" + path + "` in this program",
                        "choose of " + listed(candidatePaths(technique), pathName))
        .withField("--path");
}

bool isCandidate(Technique technique, RenderPath path) {
    const auto candidates = candidatePaths(technique);
    return std::find(candidates.begin(), candidates.end(), path) != candidates.end();
}

std::pair<Technique, RenderPath> parseForcedPath(const std::string& text) {
    const auto separator = text.find('=');
    if (separator == std::string::npos)
        throw InvalidInput("--path", "`" + text + "` is no TECHNIQUE=PATH",
                           "write for example raycast=shader")
            .withField("--path");
    const auto name = text.substr(0, separator);
    const auto technique = techniqueFromName(name);
    if (!technique)
        throw InvalidInput("--path", "there is no technique `" + name + "`",
                           "choose of " + listed(kTechniques, techniqueName))
            .withField("--path");
    const auto path = pathFromName(text.substr(separator + 1));
    if (!path || !isCandidate(*technique, *path)) throw noSuchPath(text.substr(separator + 1), *technique);
    return {*technique, *path};
}

} // namespace

const char* reasonName(PathReason reason) {
    if (reason == PathReason::Forced) return "forced";
    return reason == PathReason::Calibrated ? "calibrated" : "rule";
}

std::vector<PathChoice> choosePaths(const RenderPaths& rule, std::span<const CalibratedPath> calibrated,
                                    const ForcedPaths& forced) {
    std::vector<PathChoice> choices;
    for (const Technique technique : kTechniques) {
        PathChoice choice{technique, rule.of(technique), PathReason::Rule, candidatePaths(technique), {}};
        const auto known = std::find_if(calibrated.begin(), calibrated.end(),
                                        [&](const auto& each) { return each.technique == technique; });
        if (const auto asked = forced.find(technique); asked != forced.end()) {
            if (!isCandidate(technique, asked->second)) throw noSuchPath(pathName(asked->second), technique);
            choice.path = asked->second;
            choice.reason = PathReason::Forced;
        } else if (known != calibrated.end() && isCandidate(technique, known->path)) {
            choice.path = known->path;
            choice.reason = PathReason::Calibrated;
            choice.calibrated = *known;
        }
        choices.push_back(std::move(choice));
    }
    return choices;
}

RenderPaths pathsOf(std::span<const PathChoice> choices) {
    RenderPaths paths;
    for (const PathChoice& choice : choices)
        paths.set(choice.technique, choice.path);
    return paths;
}

ForcedPaths parseForcedPaths(const std::vector<std::string>& texts) {
    ForcedPaths forced;
    for (const std::string& text : texts) {
        const auto [technique, path] = parseForcedPath(text);
        forced[technique] = path;
    }
    return forced;
}

bool PictureDistance::isSamePicture() const {
    return static_cast<double>(pixelsApart) <=
           kUndecidedPixels + kUndecidedPart * static_cast<double>(pixels);
}

CalibratedPath fastestPath(Technique technique, RenderPath rule, std::span<const MeasuredPath> measured) {
    const auto byRule = std::find_if(measured.begin(), measured.end(),
                                     [&](const MeasuredPath& each) { return each.path == rule; });
    if (byRule == measured.end())
        throw InternalError(std::string("calibration of ") + techniqueName(technique),
                            std::string("the path of the rule, ") + pathName(rule) + ", was not measured");
    const bool ruleHolds = byRule->distance.isSamePicture();
    const auto isBetter = [&](const MeasuredPath& each, const MeasuredPath* best) {
        if (!each.distance.isSamePicture()) return false;
        if (ruleHolds && each.ms.high * kClearWin >= byRule->ms.low) return false;
        return best == nullptr || best == &*byRule || each.ms.value < best->ms.value;
    };
    const MeasuredPath* best = ruleHolds ? &*byRule : nullptr;
    for (const MeasuredPath& each : measured)
        if (isBetter(each, best)) best = &each;
    if (best == nullptr)
        throw InternalError(std::string("calibration of ") + techniqueName(technique),
                            "no path draws the picture of the shaders");
    double other = 0.0;
    for (const MeasuredPath& each : measured)
        if (&each != best && each.distance.isSamePicture() && (other == 0.0 || each.ms.value < other))
            other = each.ms.value;
    return {technique, best->path, other > 0.0 ? other / best->ms.value : 1.0, {}};
}

} // namespace voxsheet
