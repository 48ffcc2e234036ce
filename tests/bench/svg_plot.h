// Line plots as SVG: panels one above the other that share their x axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace voxsheet::bench {

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    double low = 0.0; ///< of the error bar; low == high: none
    double high = 0.0;
};

enum class PlotMarker { None, Dot, Ring };

struct PlotSeries {
    std::string label; ///< in the legend; empty: not there
    std::string colour = "#000000";
    std::vector<PlotPoint> points;
    PlotMarker marker = PlotMarker::Dot;
    double markerRadius = 2.4;
    double lineWidth = 0.0; ///< 0: no line
    bool dashed = false;
};

/// A line across a panel, with a word beside it.
struct PlotRule {
    double at = 0.0;
    std::string label;
    std::string colour = "#666666";
};

struct PlotPanel {
    std::string yLabel;
    double heightPixels = 300.0;
    std::optional<double>
        yLargest; ///< the axis ends here; points beyond are drawn as small triangles at the edge
    std::vector<PlotSeries> series;
    std::vector<PlotRule> horizontal;
    std::vector<PlotRule> vertical;
};

struct PlotFigure {
    std::string title;
    std::string subtitle;
    std::string xLabel;
    double xLargest = 1.0; ///< the x axis runs from 0 to here
    std::vector<PlotPanel> panels;
    std::vector<std::string> notes; ///< a line each, below the x axis
};

/// Round numbers from 0 to `largest`, at most `most` steps of 1, 2 or 5 times a power of ten.
[[nodiscard]] std::vector<double> roundTicks(double largest, int most);

/// A whole SVG file. Both axes begin at 0.
[[nodiscard]] std::string svgOf(const PlotFigure& figure);

} // namespace voxsheet::bench
