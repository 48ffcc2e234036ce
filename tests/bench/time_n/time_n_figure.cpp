#include "bench/time_n/time_n_figure.h"

#include "base/byte_size.h"
#include "bench/svg_plot.h"
#include "bench/time_n/time_n_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxsheet::bench {

namespace {

/// Okabe & Ito: told apart by the colour-blind as well.
constexpr std::array<const char*, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                              "#E69F00", "#56B4E9", "#000000"};
constexpr double kLargestRatioShown = 4.0;

const char* colourOf(int index) { return kColours.at(static_cast<std::size_t>(index) % kColours.size()); }

std::string longName(const std::string& technique) {
    if (technique == "vr") return "volume rendering (VR)";
    if (technique == "sr") return "surface rendering (SR)";
    if (technique == "vc") return "voxelized clipping (VC)";
    return "isosurface extraction (IE)";
}

double largestMs(const std::vector<TimeNPoint>& points) {
    double largest = 0.0;
    for (const auto& point : points)
        largest = std::max(largest, point.ms.high);
    return largest;
}

/// Milliseconds, or seconds once there are two of them.
struct TimeUnit {
    explicit TimeUnit(double largestMs) : factor(largestMs > 2000.0 ? 1e-3 : 1.0) {}
    [[nodiscard]] std::string name() const { return factor < 1.0 ? "s" : "ms"; }
    double factor;
};

PlotPoint plotted(const TimeNPoint& point, const TimeUnit& unit) {
    return {static_cast<double>(point.n), unit.factor * point.ms.value, unit.factor * point.ms.low,
            unit.factor * point.ms.high};
}

std::string settings(const TimeNResult& result) {
    const auto& options = result.options;
    const auto edge = std::to_string(options.dim);
    return edge + "³ voxels, " + std::to_string(options.scene.tilePixels.x) + "×" +
           std::to_string(options.scene.tilePixels.y) + " pixels each; texture budget " +
           byteText(options.textureBudgetBytes) + ", memory budget " + byteText(options.memoryBudgetBytes) +
           "; " + result.renderer;
}

std::string ruleText(const TimeNOptions& options) {
    return std::string("DR ") + resolutionCriterionName(options.rule.criterion);
}

void addSegments(PlotPanel& panel, const TimeNResult& result, const TimeUnit& unit) {
    int levelsNamed = -1;
    for (const auto& segment : result.segments) {
        PlotSeries series;
        series.colour = colourOf(segment.level);
        if (segment.level > levelsNamed) {
            series.label =
                "level " + std::to_string(segment.level) + (segment.level == 0 ? " (full resolution)" : "");
            levelsNamed = segment.level;
        }
        for (const auto& point : result.points)
            if (point.n >= segment.firstN && point.n <= segment.lastN)
                series.points.push_back(plotted(point, unit));
        panel.series.push_back(series);
        if (!segment.maxResidual) continue;
        PlotSeries line;
        line.colour = series.colour;
        line.marker = PlotMarker::None;
        line.lineWidth = 1.2;
        line.dashed = true;
        for (const int n : {segment.firstN, segment.lastN})
            line.points.push_back({static_cast<double>(n), unit.factor * segment.line.at(n), 0.0, 0.0});
        panel.series.push_back(line);
    }
}

/// The curve alone, for figures that hold another one.
PlotSeries plainCurve(const TimeNResult& result, const TimeUnit& unit, const std::string& label,
                      const std::string& colour) {
    PlotSeries series;
    series.label = label;
    series.colour = colour;
    series.lineWidth = 1.0;
    for (const auto& point : result.points)
        series.points.push_back(plotted(point, unit));
    return series;
}

void addTrials(PlotPanel& panel, const TimeNResult& result, const TimeUnit& unit) {
    PlotSeries series;
    series.label = "at the finer level, before the rule was found broken";
    series.colour = "#777777";
    series.marker = PlotMarker::Ring;
    for (const auto& point : result.trials)
        series.points.push_back(plotted(point, unit));
    if (!series.points.empty()) panel.series.push_back(series);
}

void addPart(PlotPanel& panel, const TimeNResult& result, const TimeUnit& unit, const char* label,
             double TimeNPoint::*part, const char* colour) {
    PlotSeries series;
    series.label = label;
    series.colour = colour;
    series.marker = PlotMarker::None;
    series.lineWidth = 1.2;
    double largest = 0.0;
    for (const auto& point : result.points) {
        series.points.push_back({static_cast<double>(point.n), unit.factor * point.*part, 0.0, 0.0});
        largest = std::max(largest, point.*part);
    }
    if (largest > 0.0) panel.series.push_back(series);
}

std::vector<PlotRule> bends(const TimeNResult& result) {
    std::vector<PlotRule> rules;
    for (const auto& transition : result.transitions) {
        if (!goesOnSteeper(transition)) continue;
        char text[160];
        std::snprintf(text, sizeof text, "N = %d: R = %.2f%s%s%s", transition.bend.lastN,
                      transition.bend.ratio.value, transition.cause == "unknown" ? "" : ", ",
                      transition.cause == "unknown" ? "" : transition.cause.c_str(),
                      transition.newLevel ? (", level " + std::to_string(*transition.newLevel)).c_str() : "");
        rules.push_back({transition.bend.lastN + 0.5, text, "#444444"});
    }
    return rules;
}

PlotSeries fittedRatios(const TimeNResult& result, const std::string& label, const std::string& colour) {
    PlotSeries fitted;
    fitted.label = label;
    fitted.colour = colour;
    for (const auto& point : result.points)
        if (point.ratio)
            fitted.points.push_back(
                {static_cast<double>(point.n), std::min(point.ratio->value, 2.0 * kLargestRatioShown),
                 std::max(0.0, point.ratio->low), std::min(point.ratio->high, 2.0 * kLargestRatioShown)});
    return fitted;
}

PlotPanel ratioPanel(const TimeNResult& result) {
    PlotPanel panel;
    panel.yLabel = "R";
    panel.heightPixels = 150.0;
    panel.yLargest = kLargestRatioShown;
    panel.horizontal = {{kPaperRatioLimit, "R = 1.5", "#B00020"}};
    for (const auto& rule : bends(result))
        panel.vertical.push_back({rule.at, "", rule.colour});
    PlotSeries raw;
    raw.label = "raw, of three points";
    raw.colour = "#999999";
    raw.markerRadius = 1.8;
    for (const auto& point : result.points)
        if (point.rawRatio) raw.points.push_back({static_cast<double>(point.n), *point.rawRatio, 0.0, 0.0});
    panel.series = {raw, fittedRatios(result, "fitted, 95 % confidence", "#0072B2")};
    return panel;
}

PlotPanel levelPanel(const TimeNResult& result) {
    PlotPanel panel;
    panel.yLabel = "level";
    panel.heightPixels = 90.0;
    int coarsest = 1;
    PlotSeries steps;
    steps.colour = "#777777";
    steps.lineWidth = 1.0;
    steps.marker = PlotMarker::None;
    for (const auto& point : result.points) {
        coarsest = std::max(coarsest, point.level);
        if (!steps.points.empty() && steps.points.back().y != point.level)
            steps.points.push_back({static_cast<double>(point.n), steps.points.back().y, 0.0, 0.0});
        steps.points.push_back({static_cast<double>(point.n), static_cast<double>(point.level), 0.0, 0.0});
    }
    panel.series.push_back(steps);
    for (int level = 0; level <= coarsest; ++level) {
        PlotSeries dots;
        dots.colour = colourOf(level);
        for (const auto& point : result.points)
            if (point.level == level)
                dots.points.push_back({static_cast<double>(point.n), static_cast<double>(level), 0.0, 0.0});
        panel.series.push_back(dots);
    }
    panel.yLargest = coarsest + 0.3;
    return panel;
}

std::vector<std::string> notesOf(const TimeNResult& result, const std::string& which) {
    auto notes = absentRegimes(result);
    if (const auto busy = busyMachine(result); !busy.empty()) notes.push_back(busy);
    for (auto& note : notes)
        note = which + note;
    return notes;
}

std::string titleOf(const TimeNScene& scene) {
    return longName(scene.technique) + (scene.shading ? ", with shading; " : ", without shading; ");
}

} // namespace

std::string timeNFigure(const TimeNResult& result) {
    const TimeUnit unit(std::max(largestMs(result.points), largestMs(result.trials)));
    PlotFigure figure;
    figure.title = titleOf(result.options.scene) + ruleText(result.options);
    figure.subtitle = settings(result);
    figure.xLabel = "number of datasets N";
    figure.xLargest = result.options.maxN + 1.0;
    PlotPanel times;
    times.yLabel = "T_N in " + unit.name();
    addSegments(times, result, unit);
    addTrials(times, result, unit);
    addPart(times, result, unit, "of which upload", &TimeNPoint::uploadMs, "#E69F00");
    addPart(times, result, unit, "of which reading", &TimeNPoint::ioMs, "#56B4E9");
    times.vertical = bends(result);
    figure.panels = {times, ratioPanel(result), levelPanel(result)};
    figure.notes = notesOf(result, {});
    return svgOf(figure);
}

std::string comparisonFigure(const TimeNResult& without, const TimeNResult& with) {
    const TimeUnit unit(std::max(largestMs(without.points), largestMs(with.points)));
    PlotFigure figure;
    const auto& scene = with.options.scene;
    figure.title = longName(scene.technique) + (scene.shading ? ", shading" : "") + ": N max " +
                   nMaxText(without) + " without DR, " + nMaxText(with) + " with";
    figure.subtitle = settings(with);
    figure.xLabel = "number of datasets N";
    figure.xLargest = std::max(without.options.maxN, with.options.maxN) + 1.0;
    PlotPanel times;
    times.yLabel = "T_N in " + unit.name();
    times.series.push_back(plainCurve(without, unit, ruleText(without.options), "#000000"));
    addSegments(times, with, unit);
    times.vertical = bends(without);
    PlotPanel ratios = ratioPanel(with);
    ratios.vertical.clear();
    ratios.series = {fittedRatios(without, "fitted, " + ruleText(without.options), "#000000"),
                     fittedRatios(with, "fitted, " + ruleText(with.options), "#0072B2")};
    figure.panels = {times, ratios, levelPanel(with)};
    figure.notes = notesOf(without, ruleText(without.options) + ": ");
    for (const auto& note : notesOf(with, ruleText(with.options) + ": "))
        figure.notes.push_back(note);
    return svgOf(figure);
}

std::string techniquesFigure(std::span<const TimeNResult> results, const std::string& title, int largestN) {
    const auto shown = [&](const TimeNPoint& point) { return point.n <= largestN; };
    double largest = 0.0;
    for (const auto& result : results)
        for (const auto& point : result.points)
            if (shown(point)) largest = std::max(largest, point.ms.high);
    const TimeUnit unit(largest);
    PlotFigure figure;
    figure.title = title;
    figure.subtitle = settings(results.front());
    figure.xLabel = "number of datasets N";
    figure.xLargest = largestN + 1.0;
    PlotPanel times;
    times.yLabel = "rendering time T_N in " + unit.name();
    times.heightPixels = 380.0;
    int index = 0;
    for (const auto& result : results) {
        auto series = plainCurve(result, unit, longName(result.options.scene.technique), colourOf(index++));
        series.lineWidth = 1.2;
        std::erase_if(series.points, [&](const PlotPoint& point) { return point.x > largestN; });
        for (const auto& transition : result.transitions)
            if (transition.newLevel && transition.bend.lastN < largestN)
                times.vertical.push_back({transition.bend.lastN + 0.5, "", series.colour});
        times.series.push_back(series);
        for (const auto& note : notesOf(result, result.options.scene.technique + ": "))
            figure.notes.push_back(note);
    }
    figure.panels = {times};
    return svgOf(figure);
}

} // namespace voxsheet::bench
