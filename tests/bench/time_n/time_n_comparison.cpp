#include "bench/time_n/time_n_comparison.h"

#include "bench/json_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace voxsheet::bench {

namespace {

std::string decimals(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string joined(const std::vector<std::string>& texts, const std::string& none) {
    std::string all;
    for (const auto& text : texts)
        all += (all.empty() ? "" : "; ") + text;
    return all.empty() ? none : all;
}

std::string transitionText(const TimeNTransition& transition) {
    return "N = " + std::to_string(transition.bend.lastN) + " (R " +
           decimals(transition.bend.ratio.value, 2) +
           (transition.cause == "unknown" ? "" : ", " + transition.cause) +
           (transition.newLevel ? ", to level " + std::to_string(*transition.newLevel) : "") + ")";
}

std::string transitionsText(const TimeNResult* result) {
    if (result == nullptr) return "not measured";
    std::vector<std::string> texts;
    for (const auto& transition : result->transitions)
        if (goesOnSteeper(transition)) texts.push_back(transitionText(transition));
    return joined(texts, "none");
}

std::string segmentsText(const TimeNResult* result) {
    if (result == nullptr) return "not measured";
    std::vector<std::string> texts;
    for (const auto& segment : result->segments) {
        auto text = "level " + std::to_string(segment.level) + ", N = " + std::to_string(segment.firstN) +
                    " to " + std::to_string(segment.lastN);
        if (segment.maxResidual) text += ": " + decimals(100.0 * *segment.maxResidual, 0) + " %";
        if (segment.slopeRatio) text += ", " + decimals(*segment.slopeRatio, 2);
        texts.push_back(text);
    }
    return joined(texts, "none");
}

std::string largestN(const TimeNResult* result) {
    return result == nullptr ? "not measured" : nMaxText(*result);
}

std::string nameOf(const TimeNComparison& comparison) {
    return comparison.technique + (comparison.shading ? ", shading" : "");
}

std::string jsonOf(const TimeNTransition& transition) {
    return jsonObject({{"n", std::to_string(transition.bend.lastN)},
                       {"ratio", jsonNumber(transition.bend.ratio.value)},
                       {"cause", jsonString(transition.cause)},
                       {"level", transition.newLevel ? std::to_string(*transition.newLevel) : "null"}});
}

std::string jsonTransitions(const TimeNResult* result, bool levelChangesOnly) {
    if (result == nullptr) return "null";
    std::vector<std::string> list;
    for (const auto& transition : result->transitions)
        if (levelChangesOnly ? transition.newLevel.has_value() : goesOnSteeper(transition))
            list.push_back(jsonOf(transition));
    return jsonArray(list);
}

std::string jsonOf(const TimeNComparison& comparison) {
    const auto number = [](const TimeNResult* result, const auto& of) {
        return result == nullptr ? std::string("null") : of(*result);
    };
    const auto nMax = [](const TimeNResult& result) { return std::to_string(result.nMax); };
    const auto maybe = [](std::optional<int> n) { return n ? std::to_string(*n) : std::string("null"); };
    return jsonObject(
        {{"technique", jsonString(comparison.technique)},
         {"shading", comparison.shading ? "true" : "false"},
         {"n_max_without", number(comparison.without, nMax)},
         {"n_max_with", number(comparison.with, nMax)},
         {"n_measured_without",
          number(comparison.without, [](const auto& r) { return std::to_string(r.points.back().n); })},
         {"n_measured_with",
          number(comparison.with, [](const auto& r) { return std::to_string(r.points.back().n); })},
         {"texture_swapping_from",
          number(comparison.without, [&](const auto& r) { return maybe(r.textureSwapN); })},
         {"disk_reading_from",
          number(comparison.without, [&](const auto& r) { return maybe(r.memorySwapN); })},
         {"transitions_without", jsonTransitions(comparison.without, false)},
         {"level_changes", jsonTransitions(comparison.with, true)}});
}

} // namespace

std::vector<TimeNComparison> comparisonsOf(std::span<const TimeNResult> results) {
    std::vector<TimeNComparison> comparisons;
    for (const auto& result : results) {
        const auto& scene = result.options.scene;
        auto found = std::find_if(comparisons.begin(), comparisons.end(), [&](const auto& each) {
            return each.technique == scene.technique && each.shading == scene.shading;
        });
        if (found == comparisons.end())
            found = comparisons.insert(found, {scene.technique, scene.shading, nullptr, nullptr});
        auto& place =
            result.options.rule.criterion == ResolutionCriterion::Off ? found->without : found->with;
        if (place == nullptr) place = &result;
    }
    return comparisons;
}

bool goesOnSteeper(const TimeNTransition& transition) {
    const double ratio = transition.bend.ratio.value;
    return transition.bend.breaksRule || (ratio > 1.0 && std::isfinite(ratio));
}

std::string nMaxText(const TimeNResult& result) {
    return (result.nMax >= result.points.back().n ? "≥ " : "") + std::to_string(result.nMax);
}

std::string summaryTable(std::span<const TimeNResult> results) {
    std::string text =
        "| technique | transitions without dynamic resolution | N max without | N max with | levels with it "
        "| "
        "per segment: largest residual, slope of its last quarter / first |\n|---|---|---|---|---|---|\n";
    std::string notes;
    for (const auto& comparison : comparisonsOf(results)) {
        text += "| " + nameOf(comparison) + " | " + transitionsText(comparison.without) + " | " +
                largestN(comparison.without) + " | " + largestN(comparison.with) + " | " +
                transitionsText(comparison.with) + " | " + segmentsText(comparison.with) + " |\n";
        for (const auto* result : {comparison.without, comparison.with}) {
            if (result == nullptr) continue;
            const auto name = nameOf(comparison) + ", --dr " +
                              resolutionCriterionName(result->options.rule.criterion) + ": ";
            for (const auto& sentence : absentRegimes(*result))
                notes += "- " + name + sentence + "\n";
            if (const auto busy = busyMachine(*result); !busy.empty()) notes += "- " + name + busy + "\n";
        }
    }
    return text + (notes.empty() ? "" : "\n" + notes);
}

std::string summaryJson(std::span<const TimeNResult> results) {
    std::vector<std::string> rows;
    for (const auto& comparison : comparisonsOf(results))
        rows.push_back(jsonOf(comparison));
    return jsonArray(rows);
}

} // namespace voxsheet::bench
