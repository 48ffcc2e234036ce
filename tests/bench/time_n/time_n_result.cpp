#include "bench/time_n/time_n_result.h"

#include "base/byte_size.h"
#include "bench/json_text.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::bench {

namespace {

std::vector<TimePoint> curveOf(std::span<const TimeNPoint> points) {
    std::vector<TimePoint> curve;
    for (const auto& point : points)
        curve.push_back({point.n, point.ms});
    return curve;
}

TimeNSegment segmentOf(std::span<const TimeNPoint> points) {
    TimeNSegment segment;
    segment.level = points.front().level;
    segment.firstN = points.front().n;
    segment.lastN = points.back().n;
    const auto curve = curveOf(points);
    if (curve.size() < 3) return segment;
    segment.line = fitStraightLine(curve);
    double largest = 0.0;
    for (const auto& point : curve)
        largest = std::max(largest, std::abs(point.ms.value - segment.line.at(point.n)) /
                                        std::max(1e-9, segment.line.at(point.n)));
    segment.maxResidual = largest;
    if (curve.size() < 8) return segment;
    const auto quarter = std::max<std::size_t>(3, curve.size() / 4);
    const std::span<const TimePoint> all(curve);
    segment.slopeRatio = fitStraightLine(all.last(quarter)).slope / fitStraightLine(all.first(quarter)).slope;
    return segment;
}

std::string jsonOf(const TimeNPoint& point) {
    const auto& ratio = point.ratio;
    return jsonObject({{"n", std::to_string(point.n)},
                       {"ms", jsonNumber(point.ms.value)},
                       {"ms_low", jsonNumber(point.ms.low)},
                       {"ms_high", jsonNumber(point.ms.high)},
                       {"wall_ms", jsonNumber(point.wallMs)},
                       {"slowdown", jsonNumber(point.slowdown)},
                       {"upload_ms", jsonNumber(point.uploadMs)},
                       {"io_ms", jsonNumber(point.ioMs)},
                       {"r_raw", jsonNumber(point.rawRatio)},
                       {"r", jsonNumber(ratio ? std::optional(ratio->value) : std::nullopt)},
                       {"r_low", jsonNumber(ratio ? std::optional(ratio->low) : std::nullopt)},
                       {"r_high", jsonNumber(ratio ? std::optional(ratio->high) : std::nullopt)},
                       {"level", std::to_string(point.level)},
                       {"resident_bytes", std::to_string(point.residentBytes)},
                       {"host_bytes", std::to_string(point.hostBytes)},
                       {"disk_bytes_per_frame", std::to_string(point.diskBytesPerFrame)}});
}

std::string jsonOf(const TimeNSegment& segment) {
    return jsonObject({{"level", std::to_string(segment.level)},
                       {"n_first", std::to_string(segment.firstN)},
                       {"n_last", std::to_string(segment.lastN)},
                       {"max_residual", jsonNumber(segment.maxResidual)},
                       {"slope_ratio", jsonNumber(segment.slopeRatio)},
                       {"slope_ms", jsonNumber(segment.line.slope)}});
}

std::string jsonOf(const TimeNTransition& transition) {
    const auto& ratio = transition.bend.ratio;
    return jsonObject({{"n", std::to_string(transition.bend.lastN)},
                       {"detected_n", std::to_string(transition.bend.detectedN)},
                       {"level", std::to_string(transition.level)},
                       {"ratio", jsonNumber(ratio.value)},
                       {"ratio_low", jsonNumber(ratio.low)},
                       {"ratio_high", jsonNumber(ratio.high)},
                       {"breaks_rule", transition.bend.breaksRule ? "true" : "false"},
                       {"cause", jsonString(transition.cause)},
                       {"new_level", transition.newLevel ? std::to_string(*transition.newLevel) : "null"}});
}

template <typename T>
std::string jsonListOf(const std::vector<T>& values) {
    std::vector<std::string> texts;
    for (const auto& value : values)
        texts.push_back(jsonOf(value));
    return jsonArray(texts);
}

std::string jsonOrNull(const std::optional<int>& number) { return number ? std::to_string(*number) : "null"; }

std::string csvRow(const TimeNOptions& options, const TimeNPoint& point, bool trial) {
    const auto number = [](std::optional<double> value) {
        const auto text = jsonNumber(value);
        return text == "null" ? std::string() : text;
    };
    const auto of = [&](double SlopeRatio::*member) {
        return number(point.ratio ? std::optional((*point.ratio).*member) : std::nullopt);
    };
    return std::to_string(point.n) + ',' + std::to_string(point.level) + ',' + number(point.ms.value) + ',' +
           number(point.ms.low) + ',' + number(point.ms.high) + ',' + number(point.uploadMs) + ',' +
           number(point.ioMs) + ',' + number(point.rawRatio) + ',' + of(&SlopeRatio::value) + ',' +
           of(&SlopeRatio::low) + ',' + of(&SlopeRatio::high) + ',' + std::to_string(point.residentBytes) +
           ',' + std::to_string(point.hostBytes) + ',' + std::to_string(point.diskBytesPerFrame) + ',' +
           (trial ? '1' : '0') + ',' + options.scene.technique + ',' + (options.scene.shading ? '1' : '0') +
           ',' + resolutionCriterionName(options.rule.criterion) + ',' + number(point.wallMs) + ',' +
           number(point.slowdown) + '\n';
}

} // namespace

std::vector<TimeNSegment> segmentsOf(const std::vector<TimeNPoint>& points) {
    std::vector<TimeNSegment> segments;
    for (std::size_t first = 0; first < points.size();) {
        auto last = first;
        while (last + 1 < points.size() && points[last + 1].level == points[first].level)
            ++last;
        segments.push_back(segmentOf(std::span(points).subspan(first, last - first + 1)));
        first = last + 1;
    }
    return segments;
}

std::vector<std::string> absentRegimes(const TimeNResult& result) {
    std::vector<std::string> sentences;
    const auto upTo = "up to N = " + std::to_string(result.points.back().n);
    if (!result.textureSwapN)
        sentences.push_back("no swapping of textures appears: " + upTo + " they fit the budget of " +
                            byteText(result.options.textureBudgetBytes));
    if (!result.memorySwapN && !result.onDisk)
        sentences.push_back("no reading from disk can appear: the datasets are in a file system in memory; "
                            "set TMPDIR to a folder on a disk");
    else if (!result.memorySwapN)
        sentences.push_back("no reading from disk appears: " + upTo +
                            " all volumes that are drawn fit the memory budget of " +
                            byteText(result.options.memoryBudgetBytes));
    return sentences;
}

std::string busyMachine(const TimeNResult& result) {
    if (result.otherLoad.value_or(0.0) <= 0.1) return {};
    return "other processes took " + std::to_string(std::lround(100.0 * *result.otherLoad)) +
           " % of the processors' time meanwhile: the times say little";
}

std::string jsonOf(const TimeNResult& result) {
    const auto& options = result.options;
    const auto& tile = options.scene.tilePixels;
    std::vector<std::string> absent;
    for (const auto& sentence : absentRegimes(result))
        absent.push_back(jsonString(sentence));
    return jsonObject({{"technique", jsonString(options.scene.technique)},
                       {"shading", options.scene.shading ? "true" : "false"},
                       {"dr", jsonString(resolutionCriterionName(options.rule.criterion))},
                       {"dim", std::to_string(options.dim)},
                       {"tile", jsonString(std::to_string(tile.x) + "x" + std::to_string(tile.y))},
                       {"texture_budget", std::to_string(options.textureBudgetBytes)},
                       {"memory_budget", std::to_string(options.memoryBudgetBytes)},
                       {"frames", std::to_string(options.frames)},
                       {"visits", std::to_string(options.visits)},
                       {"renderer", jsonString(result.renderer)},
                       {"points", jsonListOf(result.points)},
                       {"trials", jsonListOf(result.trials)},
                       {"earlier_passes", jsonListOf(result.earlierPasses)},
                       {"segments", jsonListOf(result.segments)},
                       {"transitions", jsonListOf(result.transitions)},
                       {"texture_swapping_from", jsonOrNull(result.textureSwapN)},
                       {"disk_reading_from", jsonOrNull(result.memorySwapN)},
                       {"absent_regimes", jsonArray(absent)},
                       {"n_max", std::to_string(result.nMax)},
                       {"other_processes_share", jsonNumber(result.otherLoad)},
                       {"timer_check", jsonObject({{"timestamps_ms", jsonNumber(result.timerGpuMs)},
                                                   {"host_ms", jsonNumber(result.timerHostMs)},
                                                   {"agree", result.timersAgree ? "true" : "false"}})}});
}

std::string csvOf(std::span<const TimeNResult> results) {
    std::string text =
        "n,level,ms,ms_low,ms_high,upload_ms,io_ms,r_raw,r,r_low,r_high,resident_bytes,host_bytes,"
        "disk_bytes_per_frame,trial,technique,shading,dr,wall_ms,slowdown\n";
    for (const auto& result : results) {
        for (const auto& point : result.points)
            text += csvRow(result.options, point, false);
        for (const auto& point : result.trials)
            text += csvRow(result.options, point, true);
    }
    return text;
}

} // namespace voxsheet::bench
